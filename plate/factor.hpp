#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace plate {

/// Cholesky factor of a sparse, symmetric, positive definite matrix (CHOLMOD, supernodal).
class Factor {
public:
  /// `lower`: the lower triangle. `order`: the unknowns in the order of elimination; empty: left to CHOLMOD. `shift`
  /// times the diagonal is added to it. Throws NumericalError where the matrix is not positive.
  Factor(const Eigen::SparseMatrix<double>& lower, std::vector<int> order, double shift = 0);
  ~Factor();
  Factor(Factor&&) noexcept;

  /// Solutions for all columns of `right` at once. One call at a time.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

  std::size_t bytes() const;

private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// An order of elimination with little fill for a symmetric graph, by nested dissection (METIS).
std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& lower);

}  // namespace plate
