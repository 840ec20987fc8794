#include "tests/dense.hpp"

#include <Eigen/Dense>

namespace dense {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXd folded(const Eigen::MatrixXd& K, const Eigen::MatrixXd& P) {
  return P.transpose() * K * P;
}

Eigen::MatrixXd scaled(const Eigen::MatrixXd& K, const Eigen::VectorXd& D) {
  return D.asDiagonal() * K * D.asDiagonal();
}

Eigen::VectorXd solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.ldlt().solve(b);
}

}  // namespace dense
