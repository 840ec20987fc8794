#pragma once
#include <Eigen/Core>

/// Dense linear algebra for tests of small plates, compiled once.
namespace dense {

/// Ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// Of A x = lambda B x with a positive B, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// P^T K P.
Eigen::MatrixXd folded(const Eigen::MatrixXd& K, const Eigen::MatrixXd& P);

/// D K D with the diagonal D.
Eigen::MatrixXd scaled(const Eigen::MatrixXd& K, const Eigen::VectorXd& D);

/// A^-1 b of a symmetric A.
Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace dense
