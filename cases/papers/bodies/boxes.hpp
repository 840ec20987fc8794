#pragma once
#include "cases/papers/bodies/loaded.hpp"

/// Boxes with surface nodes (Sca23 4): E = 1 GPa, nu = 0.3, influence of Gauss, horizon of three spacings, exact shares
/// of cells.
namespace boundary_bodies {

/// A box of `counts` nodes along x, y, z.
Solid elastic_box(const std::vector<int>& counts, double spacing);

/// Sca23 39 for the traction 1 out of the upper face of x, held across the lower faces.
Eigen::Vector3d pulled_box(const Eigen::Vector3d& at);
/// Solution with the moduli that the sums over the lattice have.
Field pulled_box_of_lattice(const Solid& box);

/// A box under the made-up loading of Sca23 4.2, held on its face x = 0.
struct MadeBox {
  explicit MadeBox(const std::vector<int>& counts, double length = 0.3);

  Field field() const;            ///< Sca23 42 about the middle of the held face
  Conditions conditions() const;  ///< Sca23 40, 41
  /// Largest errors (Sca23 38). `corrected`: symmetric about the middle of z, where the number of nodes is even.
  double uncorrected() const;
  double corrected(int order, plate::FluxRule rule) const;

  Solid solid;
  Eigen::Vector3d middle;
};

}  // namespace boundary_bodies
