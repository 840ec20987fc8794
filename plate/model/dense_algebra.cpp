#include "plate/model/dense_algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace plate {
namespace {

template <typename Solver>
Eigenpairs pairs(const Solver& solver) {
  return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Eigen::Success};
}

using Decomposition = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;

}  // namespace

Eigenpairs eigenpairs(const Eigen::Ref<const Eigen::MatrixXd>& symmetric) {
  return pairs(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric));
}

Eigenpairs eigenpairs(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return pairs(Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B));
}

Eigenpairs tridiagonal_eigenpairs(const Eigen::Ref<const Eigen::VectorXd>& diagonal,
                                  const Eigen::Ref<const Eigen::VectorXd>& beside) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd(diagonal), Eigen::VectorXd(beside));
  return pairs(solver);
}

PseudoInverse pseudo_inverse(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  const Decomposition decomposition(matrix);
  return {decomposition.pseudoInverse(), decomposition.rank()};
}

LeastNorm least_norm(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::VectorXd>& b) {
  const Decomposition decomposition(A);
  return {decomposition.solve(b), decomposition.rank()};
}

}  // namespace plate
