#pragma once
#include "cases/papers/bodies/solid.hpp"

/// The plate clamped on all edges and loaded along x in its plane (Sca21 6.2, table 4): 3 m x 2 m, 0.05 m thick.
namespace boundary_bodies {

constexpr double clamped_plate_load = 1e6;  // along x [N/m^3], any

/// Its 30 x 20 nodes in plane stress; influence as for the bars: the paper gives neither.
Solid clamped_plate();

/// The local solution by Ritz's method: (1 - x^2) times Legendre polynomials, u even in x and y, v odd in both, the
/// middle of the plate at 0. Unknown c n^2 + i n + j: component c, shapes 2 i + c along x and 2 j + c along y.
class RitzClampedPlate {
public:
  /// `count`: shapes in each direction
  explicit RitzClampedPlate(int count);
  /// Displacement at a place from the lower left corner [m].
  Eigen::Vector3d operator()(const Eigen::Vector3d& from_corner) const;

private:
  /// Integrals over [-1, 1] of shape a times shape b, of the derivative of a times b, of both derivatives, of shape a.
  struct Products {
    Eigen::MatrixXd plain, left, both;
    Eigen::VectorXd sums;
  };
  static Products shape_products(int count);
  std::array<int, 3> shapes(int unknown) const;

  int n_;
  Eigen::VectorXd weights_;
};

/// Displacements of the nodes with fictitious nodes expanded to this order, edges held by multipliers (Sca21 63).
Eigen::VectorXd clamped_by_multipliers(const Solid& plate, int order);

/// Displacements of the nodes without corrections: outer nodes have the reference.
Eigen::VectorXd uncorrected_clamped(const Solid& plate, const RitzClampedPlate& reference);

/// Largest errors of u and of v in percent of the largest displacement (Sca21 70).
Eigen::Array2d clamped_errors(const Solid& plate, const Eigen::VectorXd& u, const RitzClampedPlate& reference);

}  // namespace boundary_bodies
