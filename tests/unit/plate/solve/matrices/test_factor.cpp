#include "plate/solve/matrices/factor.hpp"

#include <Eigen/Dense>
#include <random>

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

/// Springs between neighbours of a grid and to the ground, of random stiffness.
Eigen::MatrixXd springs(Eigen::Index columns, Eigen::Index rows) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(0.1, 10);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(columns * rows, columns * rows);
  const auto join = [&](Eigen::Index i, Eigen::Index j) {
    const double k = value(random);
    K(i, i) += k, K(j, j) += k, K(i, j) -= k, K(j, i) -= k;
  };
  for (Eigen::Index y = 0; y < rows; ++y)
    for (Eigen::Index x = 0; x < columns; ++x) {
      const auto i = y * columns + x;
      K(i, i) += 0.01;
      if (x + 1 < columns) join(i, i + 1);
      if (y + 1 < rows) join(i, i + columns);
    }
  return K;
}

Eigen::SparseMatrix<double> lower(const Eigen::MatrixXd& K) {
  return Eigen::MatrixXd(K.triangularView<Eigen::Lower>()).sparseView();
}

}  // namespace

TEST_CASE("factor: solutions for all columns at once, with and without a share of the diagonal added") {
  const auto K = springs(12, 9);
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(K.rows(), 3);
  for (const double shift : {0.0, 0.5}) {
    Eigen::MatrixXd shifted = K;
    shifted.diagonal() *= 1 + shift;
    const Factor factor(lower(K), shift);
    const Eigen::MatrixXd x = factor.solve(right);
    CHECK((shifted * x - right).cwiseAbs().maxCoeff() < 1e-12 * x.cwiseAbs().maxCoeff() * 40);  // measured: 3e-14
    CHECK(factor.bytes() >= std::size_t(lower(K).nonZeros()) * sizeof(double));
  }
}

TEST_CASE("factor: of any sign it solves, and counts the negative eigenvalues") {
  Eigen::MatrixXd K = springs(12, 9);
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(K.rows(), 2);
  for (const double less : {0.0, 0.5, 2.0, 8.0}) {
    K.diagonal().array() -= less;
    const auto factor = Factor::of_any_sign(lower(K));
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
    CHECK(factor.negative() == std::size_t((values.array() < 0).count()));
    const Eigen::MatrixXd x = factor.solve(right);
    CHECK((K * x - right).cwiseAbs().maxCoeff() < 1e-9 * x.cwiseAbs().maxCoeff() * 40);
    CHECK(factor.bytes() >= std::size_t(lower(K).nonZeros()) * sizeof(double));
  }
}

TEST_CASE("factor: what is not positive is refused, and is not where enough is added") {
  Eigen::MatrixXd K = springs(3, 3);
  K(4, 4) = -1;
  CHECK_THROWS_AS(Factor(lower(K)), NumericalError);
  const Eigen::MatrixXd indefinite{{1, 2}, {2, 1}};
  CHECK_THROWS_AS(Factor(lower(indefinite)), NumericalError);
  CHECK_NOTHROW(Factor(lower(indefinite), 1.5));
}
