#include "plate/model/dense_algebra.hpp"

#include <limits>
#include <random>

#include "tests/catch.hpp"

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double rounding = 1e-13;  // measured: 3e-15 at most, of numbers of size 1

MatrixXd random(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&](auto, auto) { return uniform(generator); });
}

double largest(const MatrixXd& m) {
  return m.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("eigenpairs are ascending and give the matrix back, of both problems and of tridiagonal matrices") {
  const MatrixXd a = random(7, 7, 1), A = a + a.transpose();
  const MatrixXd b = random(7, 7, 2), B = b * b.transpose() + MatrixXd::Identity(7, 7);
  const auto of_A = plate::eigenpairs(A), of_both = plate::eigenpairs(A, B);
  CHECK(of_A.found);
  CHECK(largest(A * of_A.vectors - of_A.vectors * of_A.values.asDiagonal()) < rounding * 10);
  CHECK(largest(A * of_both.vectors - B * of_both.vectors * of_both.values.asDiagonal()) < rounding * 10);
  for (const VectorXd& values : {of_A.values, of_both.values}) CHECK((values.tail(6) - values.head(6)).minCoeff() > 0);

  // 2, -1: 2 - 2 cos(k pi / 6)
  const auto chain = plate::tridiagonal_eigenpairs(VectorXd::Constant(5, 2), VectorXd::Constant(4, -1));
  for (int k = 1; k <= 5; ++k) CHECK(std::abs(chain.values[k - 1] - (2 - 2 * std::cos(k * M_PI / 6))) < rounding);
}

TEST_CASE("eigenpairs of what is not finite are not found") {
  MatrixXd A = MatrixXd::Identity(3, 3);
  A(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(plate::eigenpairs(A).found);
}

TEST_CASE("the pseudo-inverse meets Penrose's conditions at full and lesser rank") {
  const MatrixXd full = random(8, 3, 3), lesser = random(8, 2, 4) * random(2, 5, 5);
  for (const MatrixXd& A : {full, lesser}) {
    const auto [inverse, rank] = plate::pseudo_inverse(A);
    CHECK(rank == (A.cols() == 3 ? 3 : 2));
    CHECK(largest(A * inverse * A - A) < rounding);
    CHECK(largest(inverse * A * inverse - inverse) < rounding * 10);
    CHECK(largest(A * inverse - (A * inverse).transpose()) < rounding);
    CHECK(largest(inverse * A - (inverse * A).transpose()) < rounding);
  }
}

TEST_CASE("a solution of least norm leaves nothing along the columns and has nothing in the null space") {
  const MatrixXd A = random(4, 2, 6) * random(2, 6, 7);
  const VectorXd b = random(4, 1, 8);
  const auto [x, rank] = plate::least_norm(A, b);
  CHECK(rank == 2);
  CHECK(largest(A.transpose() * (A * x - b)) < rounding);
  CHECK(largest(x - plate::pseudo_inverse(A).inverse * A * x) < rounding);
}
