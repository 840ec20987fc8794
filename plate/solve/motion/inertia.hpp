#pragma once
#include <Eigen/SparseCore>
#include "geometry/cells/tessellation.hpp"
#include "plate/model/constraints.hpp"
#include "plate/model/section.hpp"

namespace plate {

/// The mass matrix of a plate on its free degrees of freedom.
class Inertia {
public:
  /// Diagonal, as from mass().
  explicit Inertia(Forces mass) : diagonal_(std::move(mass)) {}

  /// The consistent mass of the cells of a Galerkin plate, in which deflection and rotations are linear, in squares bilinear
  /// (theory.md, "Dynamics"). `rotary`: factor of the rotary inertia. `constraints` must outlive this.
  Inertia(const Section& section, const geometry::Tessellation& cells, const Constraints& constraints, double rotary);

  /// P^T M u of u = P q [3 x points].
  Forces operator()(const State& state) const;

private:
  Forces diagonal_;                    // or, of cells:
  Eigen::SparseMatrix<double> areas_;  // integrals of products [length^2], symmetric
  double translation_ = 0, rotation_ = 0;
  const Constraints* constraints_ = nullptr;
};

}  // namespace plate
