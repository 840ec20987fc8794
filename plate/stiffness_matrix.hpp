#pragma once
#include <Eigen/SparseCore>

#include "plate/constraints.hpp"
#include "plate/family_operator.hpp"
#include "plate/galerkin_operator.hpp"

namespace plate {

/// The free degrees of freedom that have stiffness, numbered one after the other.
struct Unknowns {
  std::vector<std::int32_t> index;  // per degree of freedom 3 * point + component; -1: none
  std::vector<std::uint32_t> dof;   // per unknown

  Eigen::Index size() const { return static_cast<Eigen::Index>(dof.size()); }
};

/// `diagonal`: of P^T diag(K) P, zero at held degrees of freedom (Constraints::fold_diagonal).
Unknowns unknowns(const Forces& diagonal);

/// Rows, ascending, and values of one column.
using MatrixColumn = std::vector<std::pair<std::int32_t, double>>;
Eigen::SparseMatrix<double> compressed(const std::vector<MatrixColumn>& columns);

/// P^T K P of the unknowns, lower triangle. `with_dilatation` = false leaves out the energy a theta^2 and with it the
/// couplings between the neighbours of a point.
Eigen::SparseMatrix<double> stiffness_matrix(const FamilyOperator& plate, const Constraints& constraints,
                                             const Unknowns& unknowns, bool with_dilatation);

Eigen::SparseMatrix<double> stiffness_matrix(const GalerkinOperator& plate, const Constraints& constraints,
                                             const Unknowns& unknowns);

/// Pairs of points that share a bond, lower triangle; the ones that the matrix couples without dilatation.
Eigen::SparseMatrix<double> point_graph(const geometry::Families& families);

}  // namespace plate
