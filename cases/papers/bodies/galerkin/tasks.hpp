#pragma once
#include "cases/papers/bodies/galerkin/mixed.hpp"

/// Plane problems on images of the unit square, solved by a basis on points and by biquadratic elements.
namespace galerkin_systems {

/// s: a place in the unit square.
struct Task {
  Map map;
  std::function<Eigen::Vector2d(const Eigen::Vector2d& s)> held;      ///< 0, or NaN where a component is free
  std::function<Eigen::Vector2d(const Eigen::Vector2d& s)> traction;  ///< at the middle of a piece of the outline
  Eigen::Vector2d watched;                                            ///< where u_y is asked for
};

/// Bode 7.1, small strains: the panel of 48 with ends 44 and 16 high, held on the left, sheared by 1 / 16 on the right.
Task cook();

/// Bode 7.3.3 in the plane, small strains, the right half: 1 x 1, pressed by 1 on the left half of its top, where u_x
/// is held as on the line of symmetry; u_y is held at the bottom. The loaded part of the thesis is in a figure alone.
Task punched_block();

/// 8 x 2, held on the left, sheared by 1 on the right.
Task cantilever();

struct Grid {
  int columns, rows;
  double perturbation = 0;
};

/// Points, and their places in the unit square.
struct Placed {
  Body body;
  Eigen::Matrix2Xd places;
};

Placed placed(const Task& task, const Grid& grid, Reach reach);

/// Half of each loaded edge's force at either end, 2 x points.
Eigen::VectorXd loads(const Task& task, const Placed& points);
Eigen::VectorXd supports(const Task& task, const Placed& points);

struct Answer {
  double watched;
  double pressure_error;  ///< root mean square over inner points, of the reference's
  double
      checkerboard;  ///< rms of (p1 - p2 + p3 - p4) / 4 around inner cells over that of p: a smooth field's is O(h^2)
};

/// Biquadratic displacements, pressures linear in each element and discontinuous (Q2/P-1): no points, families,
/// samples.
struct Reference {
  double watched;
  std::function<double(const Eigen::Vector2d& s)> pressure;
};

Reference quadratic_elements(const Solid& solid, const Task& task, const Grid& grid);

/// Bode 7.3.8: the sum of the stiffness of four-noded elements on the cells whose middles the predicate holds, and of
/// families on the others, cut at the interface and corrected to its normals. The interface's nodes are both's.
Sparse coupled(const Solid& solid, const Body& whole, const std::function<bool(const Eigen::Vector2d&)>& in_elements,
               const std::function<Sparse(const Body&)>& stiffness_of_families);

/// Bode 7.3.8: a quarter of a plate with a hole of radius 1, to the square of half side 4, pulled by 1 along x; the
/// outer edges have the tractions of the infinite plate. On the unit square the hole is s_x = 0, s_y is the angle from
/// x. The thesis has its dimensions in a figure alone.
Task plate_with_hole();

/// Whether a point is in the outer half of the cells, which are elements.
bool beyond_hole(const Eigen::Vector2d& x);

/// Stress and, in plane strain, displacement of the infinite plate (Kirsch).
Eigen::Matrix2d hole_stress(const Eigen::Vector2d& x);
Eigen::Vector2d hole_displacement(const Solid& solid, const Eigen::Vector2d& x);

Answer answer(const Solid& solid, const Basis& basis, const Task& task, const Grid& grid, const Reference& reference);

}  // namespace galerkin_systems
