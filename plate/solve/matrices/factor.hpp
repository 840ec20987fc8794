#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "plate/model/errors.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// A stiffness that is not positive, and the unknown whose pivot is not.
class NegativePivot : public NumericalError {
public:
  explicit NegativePivot(std::size_t at)
      : NumericalError("factorisation: the stiffness is not positive"), unknown(at) {}

  std::size_t unknown;
};

/// Cholesky factor of a sparse, symmetric, positive definite matrix (CHOLMOD, supernodal).
class Factor {
public:
  /// `lower`: the lower triangle, its unknowns in the order of elimination. `shift` times the diagonal is added to it.
  /// Throws NegativePivot where the matrix is not positive, and NumericalError where memory does not suffice.
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

/// Factor of a sparse, symmetric matrix with few negative eigenvalues: the Cholesky factor of the matrix with springs
/// at the unknowns whose pivots would be negative, and Woodbury's formula, which takes the springs away.
class IndefiniteFactor {
public:
  /// `lower`: as Factor has it. `springs`: unknowns that are tried first; then those that have springs.
  /// @throws NumericalError  where more springs are needed than a few, or the matrix is singular
  IndefiniteFactor(Eigen::SparseMatrix<double> lower, std::vector<std::size_t>& springs);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// Number of negative eigenvalues.
  std::size_t negative() const { return negative_; }
  std::size_t bytes() const { return factor_->bytes(); }

private:
  std::unique_ptr<const Factor> factor_;  // with the springs
  std::vector<std::size_t> springs_;
  Eigen::MatrixXd by_springs_;  // displacements by a unit force of each
  Eigen::MatrixXd inverse_;     // forces of the springs by their displacements without them
  std::size_t negative_ = 0;
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
