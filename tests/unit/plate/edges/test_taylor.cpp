#include "plate/edges/extrapolation.hpp"

#include <random>

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using plate::taylor_weights;

namespace {

/// 1 + a x + b y + ... to the power of the order: has all terms up to it.
double taylor_polynomial(const Eigen::VectorXd& x, int order) {
  double sum = 0.7;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum += (0.3 + 0.2 * double(i)) * x[i];
  return std::pow(sum, order);
}

double value(const Eigen::VectorXd& weights, const Eigen::MatrixXd& nodes, int order) {
  double sum = 0;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) sum += weights[i] * taylor_polynomial(nodes.col(i), order);
  return sum;
}

}  // namespace

TEST_CASE("taylor: exact for polynomials up to its order, in one to three dimensions, with more nodes than needed") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (int order = 0; order <= 4; ++order)
      for (const int more : {0, 3}) {
        const Eigen::MatrixXd nodes = Eigen::MatrixXd::NullaryExpr(
            dimension, plate::taylor_terms(dimension, order) + more, [&] { return uniform(random); });
        const Eigen::VectorXd at = Eigen::VectorXd::Constant(dimension, 1.2);
        const Eigen::VectorXd weights = taylor_weights(nodes, at, order);
        const double sizes = weights.cwiseAbs().sum();
        CHECK(std::abs(value(weights, nodes, order) - taylor_polynomial(at, order)) <
              1e-14 * sizes);  // measured: 4e-16
      }
}

TEST_CASE("taylor: of a row of nodes, the weights of Lagrange's polynomials") {
  const Eigen::MatrixXd nodes = Eigen::RowVector4d(0, 1, 2, 3);
  const Eigen::VectorXd weights = taylor_weights(nodes, Eigen::VectorXd::Constant(1, -2), 3);
  CHECK((weights - Eigen::Vector4d(10, -20, 15, -4)).norm() < 1e-12);  // measured: 1e-14
}

TEST_CASE("taylor: least squares go through the first node") {
  const Eigen::MatrixXd nodes = Eigen::RowVector4d(0, 1, 2, 3);
  const Eigen::VectorXd there = taylor_weights(nodes, Eigen::VectorXd::Zero(1), 1);
  CHECK((there - Eigen::Vector4d::Unit(0)).norm() < 1e-14);
  const Eigen::VectorXd at = taylor_weights(nodes, Eigen::VectorXd::Constant(1, -1), 1);
  CHECK((at - Eigen::Vector4d(20, -1, -2, -3) / 14).norm() < 1e-14);  // slope of least squares: sum x u / sum x^2
}

TEST_CASE("taylor: refuses nodes that do not determine the derivatives") {
  const Eigen::Vector2d at(1, 1);
  CHECK_THROWS_AS(taylor_weights(Eigen::Matrix2d::Identity(), at, 1), plate::Refused);
  CHECK_THROWS_AS(taylor_weights(Eigen::MatrixXd{{0, 1, 2}, {0, 1, 2}}, at, 1), plate::Refused);
  CHECK_NOTHROW(taylor_weights(Eigen::MatrixXd{{0, 1, 2}, {0, 1, 3}}, at, 1));
}
