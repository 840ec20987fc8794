#pragma once
#include "cases/papers/bodies/solid.hpp"

/// Families on lattices with exact shares of cells: of intervals, squares within a circle, cubes within a sphere.
namespace boundary_bodies {

/// @param horizon_ratio  horizon / spacing
Family family_of(int dimension, double horizon_ratio);

/// Area of a disc about the origin inside a rectangle; volume of a ball inside a box, to 1e-12 of it or better.
double area_in_disc(double radius, const Eigen::Vector2d& low, const Eigen::Vector2d& high);
double volume_in_ball(double radius, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// Mean over the family, weighted by influence, length^2 and fraction, of m_1^p m_2^q, m the bonds' unit vectors:
/// lattice moduli are made of it.
double mean_of_directions(const Family& family, double horizon, const Influence& influence, int p, int q);

/// Shares of the third shell, (3, 0) and its like, changed so that the moduli are those of the continuum in two
/// dimensions: the mean of m_1^4 is three times that of m_1^2 m_2^2.
Family fitted(Family plane, double horizon, const Influence& influence);

}  // namespace boundary_bodies
