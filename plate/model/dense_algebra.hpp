#pragma once
#include <Eigen/Core>

/// Decompositions of small dense matrices, compiled once: instantiated where they are used, they made thirteen units
/// compile three times as long.
namespace plate {

/// A v = lambda v, or A v = lambda B v: values ascending, a column of `vectors` for each.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
  bool found;  // the iteration converged
};
Eigenpairs eigenpairs(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);
/// Eigenpairs of A v = lambda B v with a positive definite B.
Eigenpairs eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Eigenpairs of a symmetric tridiagonal matrix: diagonal [n], entries beside it [n - 1].
Eigenpairs tridiagonal_eigenpairs(const Eigen::Ref<const Eigen::VectorXd>& diagonal,
                                  const Eigen::Ref<const Eigen::VectorXd>& beside);

/// Moore-Penrose inverse [n x m] of the matrix of m equations for n unknowns, with its rank.
struct PseudoInverse {
  Eigen::MatrixXd inverse;
  Eigen::Index rank;
};
PseudoInverse pseudo_inverse(const Eigen::Ref<const Eigen::MatrixXd>& matrix);

/// The x of least norm that leaves the least of A x - b.
struct LeastNorm {
  Eigen::VectorXd x;
  Eigen::Index rank;
};
LeastNorm least_norm(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& b);

}  // namespace plate
