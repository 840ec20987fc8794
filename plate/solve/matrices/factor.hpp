#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

class DistributedInverse;

/// Cholesky factor of a sparse, symmetric, positive definite matrix (CHOLMOD, supernodal), or of one that ranks share.
class Factor {
public:
  /// The factor of the rows of all ranks, of any sign; its unknowns here are those of the points that the rank owns,
  /// point by point.
  explicit Factor(std::unique_ptr<const DistributedInverse> shared);
  /// `lower`: the lower triangle, its unknowns in the order of elimination. `shift` times the diagonal is added to it.
  /// Throws NumericalError where the matrix is not positive.
  explicit Factor(const Eigen::SparseMatrix<double>& lower, double shift = 0);
  /// The factor of a matrix that need not be positive: where it is not, L D L^T without supernodes and without a search
  /// for pivots, some times slower.
  /// @throws NumericalError  where it is singular
  static Factor of_any_sign(const Eigen::SparseMatrix<double>& lower);
  ~Factor();
  Factor(Factor&&) noexcept;

  /// Solutions for all columns of `right` at once. One call at a time.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

  /// Number of negative eigenvalues, that of negative pivots.
  std::size_t negative() const;
  std::size_t bytes() const;

private:
  struct Handle;
  Factor(const Eigen::SparseMatrix<double>& lower, double shift, bool positive);

  std::unique_ptr<Handle> handle_;                    // null where ranks share the matrix
  std::unique_ptr<const DistributedInverse> shared_;  // null elsewhere
};

/// The points that have unknowns (`diagonal` is positive there) in an order of elimination with little fill, children
/// before parents and next to them. Minimum degree for few points, nested dissection (METIS) for more.
std::vector<int> elimination_order(const PointMatrix& matrix, const Forces& diagonal);

/// The factors of a matrix that need not be symmetric, by UMFPACK: for patterns that nearly are, as those of bonds,
/// seven times as fast as Eigen's SparseLU in half the memory (19,200 unknowns: 2.1 s and 0.24 GB).
class GeneralFactor {
public:
  /// Sparse matrix with indices of 64 bits: factors of 40,000 points have more than 2^31 bytes.
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, long>;

  /// `A`: square, compressed.
  /// @throws NumericalError  where it is singular
  /// @throws std::bad_alloc  where memory does not suffice
  explicit GeneralFactor(const Eigen::SparseMatrix<double>& A);

  /// A^-1 b, refined.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  const Matrix& matrix() const { return A_; }
  std::size_t bytes() const { return bytes_; }

private:
  Matrix A_;
  std::shared_ptr<void> numeric_;
  std::size_t bytes_ = 0;
};

}  // namespace plate
