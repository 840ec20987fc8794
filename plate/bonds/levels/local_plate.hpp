#pragma once
#include <memory>

#include "plate/model/boundary.hpp"
#include "plate/solve/matrices/factor.hpp"
#include "plate/solve/preconditioner.hpp"
#include "plate/bonds/stiffness_matrix.hpp"

namespace plate {

/// The same plate with a horizon of 1.5 spacings and without dilatation, factorised, between two Jacobi sweeps: its
/// stiffness follows that of the plate for every wave that the lattice carries (theory.md, "Statics").
class LocalPlate : public Preconditioner {
public:
  /// `plate` and `boundary` must outlive this.
  LocalPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
             const Discretization& discretization);

  void apply(const Forces& residual, State& result) const override;

  std::size_t bytes() const override { return factor_->bytes(); }

private:
  const FamilyOperator& plate_;
  const Constraints& constraints_;
  Forces inverse_diagonal_;  // of the plate, times the weight of a sweep
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
  mutable Forces product_, rest_;
};

/// The plate itself, assembled and factorised: conjugate gradients with it end after one or two iterations.
class AssembledPlate : public Preconditioner {
public:
  AssembledPlate(const FamilyOperator& plate, const Constraints& constraints);
  AssembledPlate(const GalerkinOperator& plate, const Constraints& constraints);

  void apply(const Forces& residual, State& result) const override;

  /// P^T K P u = P^T f for several loads at once.
  std::vector<State> solve(const std::vector<Forces>& loads) const;

  std::size_t bytes() const override { return factor_->bytes(); }

private:
  AssembledPlate(const Operator& plate, const Constraints& constraints, const PointMatrix& matrix);

  const Constraints& constraints_;
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
};

/// The plate of LocalPlate: bonds up to 1.5 spacings, bond-based, with the stiffness of the plate given.
FamilyOperator local_operator(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                              const Discretization& discretization);

/// The factor of a matrix (lower triangle) that is positive but for zeros, which are lifted.
std::unique_ptr<Factor> factorised(const Eigen::SparseMatrix<double>& matrix);

/// The unknowns of nodal forces, one after the other.
Eigen::VectorXd gathered(const Unknowns& unknowns, const Forces& forces);

/// The diagonal of P^T K P, zero at held degrees of freedom.
Forces folded_diagonal(const Operator& plate, const Constraints& constraints);

}  // namespace plate
