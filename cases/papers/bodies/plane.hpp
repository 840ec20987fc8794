#pragma once
#include "cases/papers/bodies/fractions.hpp"
#include "cases/papers/bodies/loaded.hpp"

/// A square in plane strain, and what it is loaded with (Sca23 5 and, in two dimensions, 4.2).
namespace boundary_bodies {

/// 1 x 1, E = 1, influence of Gauss, horizon of three spacings, exact shares of cells.
Solid plane_square(double poisson, int count = 20);

/// Solutions of `pulled(1, 1)`: Sca23 43; with the moduli that the sums over the lattice have.
Field pulled_square(double poisson);
Field pulled_square_of_lattice(const Solid& square);

/// Sca23 42 in two dimensions.
Eigen::Vector3d made_field(const Eigen::Vector3d& at);

/// Its supports and loads, those of the local theory (Sca23 40, 41), with or without the nonlocal part of the shear
/// stress.
Conditions made(const Solid& square, double poisson, bool nonlocal = false);

}  // namespace boundary_bodies
