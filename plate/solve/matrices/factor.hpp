#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// Cholesky factor of a sparse, symmetric, positive definite matrix (CHOLMOD, supernodal).
class Factor {
public:
  /// `lower`: the lower triangle, its unknowns in the order of elimination. `shift` times the diagonal is added to it.
  /// Throws NumericalError where the matrix is not positive.
  explicit Factor(const Eigen::SparseMatrix<double>& lower, double shift = 0);
  ~Factor();
  Factor(Factor&&) noexcept;

  /// Solutions for all columns of `right` at once. One call at a time.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

  std::size_t bytes() const;

private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// The points that have unknowns (`diagonal` is positive there) in an order of elimination with little fill, children
/// before parents and next to them. Minimum degree for few points, nested dissection (METIS) for more.
std::vector<int> elimination_order(const PointMatrix& matrix, const Forces& diagonal);

}  // namespace plate
