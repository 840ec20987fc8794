#include "plate/edges/boundary_conditions.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

SparseStiffness matrix(const Eigen::MatrixXd& dense) {
  return dense.sparseView(1, 0);
}

}  // namespace

TEST_CASE("scaled factor: a matrix that is not symmetric, its rows and columns in unlike units") {
  const Eigen::Matrix3d A{{2e9, -1e3, 0}, {3e9, 4e3, 1e-3}, {0, 1e-6, -5e-12}};
  const Eigen::Vector3d x(1e-3, 2e3, 7e9);
  const ScaledFactor factor(matrix(A));
  CHECK((factor.solve(A * x) - x).cwiseQuotient(x).cwiseAbs().maxCoeff() < 1e-12);  // measured: 2e-16
  CHECK(factor.bytes() > 0);
  CHECK(ScaledFactor(SparseStiffness(0, 0)).solve(Eigen::VectorXd(0)).size() == 0);
}

TEST_CASE("scaled factor: unknowns without stiffness and dependent rows are refused") {
  CHECK_THROWS_AS(ScaledFactor(matrix(Eigen::Matrix2d{{1, 0}, {1, 0}})), NumericalError);
  CHECK_THROWS_AS(ScaledFactor(matrix(Eigen::Matrix2d{{1, 2}, {2, 4}})).solve(Eigen::Vector2d(1, 0)), NumericalError);
}
