#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "plate/formulation/constraints.hpp"

namespace plate {

/// A symmetric matrix in blocks of 3 x 3, one for every pair of points that it couples: those on and below the
/// diagonal, column by column.
struct PointMatrix {
  std::vector<std::size_t> first{0};   // where the blocks of a column begin [points + 1]
  std::vector<std::uint32_t> row;      // ascending in every column, from the diagonal on
  std::vector<Eigen::Matrix3d> block;  // K_(row, column)

  std::size_t points() const { return first.size() - 1; }
};

/// Free degrees of freedom with stiffness, numbered one after the other, those of a point together.
struct Unknowns {
  std::vector<std::int32_t> index;  // per degree of freedom 3 * point + component; -1: none
  std::vector<std::uint32_t> dof;   // per unknown

  Eigen::Index size() const { return static_cast<Eigen::Index>(dof.size()); }
};

/// `diagonal`: of P^T diag(K) P, zero at held degrees of freedom (Constraints::fold_diagonal). `order`: the points that
/// have unknowns, in the order of those; empty: ascending.
Unknowns unknowns(const Forces& diagonal, const std::vector<int>& order = {});

/// P^T K P: what degrees of freedom that follow others have goes to those.
PointMatrix folded(PointMatrix matrix, const Constraints& constraints);

/// Blocks that are zero but for rounding left out; the diagonal stays.
PointMatrix without_rounding(const PointMatrix& matrix);

/// The lower triangle of the matrix of the unknowns.
Eigen::SparseMatrix<double> of_unknowns(const PointMatrix& matrix, const Unknowns& unknowns);

}  // namespace plate
