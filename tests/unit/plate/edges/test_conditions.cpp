#include "plate/edges/boundary_conditions.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;

namespace {

/// A chain of springs of stiffness 2 between four points.
SparseStiffness chain() {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(4, 4);
  for (int i = 0; i < 3; ++i) K.block<2, 2>(i, i) += 2 * Eigen::Matrix2d{{1, -1}, {-1, 1}};
  return K.sparseView();
}

const Eigen::Vector4d force(0, 0, 0, 6);

}  // namespace

TEST_CASE("conditions: held unknowns have their values and reactions balance the forces") {
  const auto solution = constrained_solution(chain(), force, {{0, 0.5}});
  CHECK((solution.values - Eigen::Vector4d(0.5, 3.5, 6.5, 9.5)).norm() < 1e-13);
  CHECK(solution.reactions[0] == Approx(-6));
}

TEST_CASE("conditions: with all unknowns held, reactions alone") {
  const auto solution = constrained_solution(chain(), Eigen::Vector4d::Zero(), {{0, 0}, {1, 0}, {2, 0}, {3, 1}});
  CHECK((solution.reactions - Eigen::Vector4d(0, 0, -2, 2)).norm() < 1e-14);
}

TEST_CASE("conditions: a multiplier on a value is minus what holds it, none on a value that is there anyway") {
  const SparseStiffness B = Eigen::MatrixXd(Eigen::RowVector4d(1, 0, 0, 0)).sparseView();
  const auto solution = solution_with_multipliers(chain(), B, force, Eigen::VectorXd::Constant(1, 0.5));
  CHECK((solution.values - Eigen::Vector4d(0.5, 3.5, 6.5, 9.5)).norm() < 1e-13);
  CHECK(solution.multipliers[0] == Approx(6));
  CHECK((solution.added_forces - Eigen::Vector4d(6, 0, 0, 0)).norm() < 1e-13);
  const Eigen::Vector4d balanced(-6, 0, 0, 6);
  const auto free = solution_with_multipliers(chain(), B, balanced, Eigen::VectorXd::Constant(1, 0.5));
  CHECK(std::abs(free.multipliers[0]) < 1e-13);
}

TEST_CASE("conditions: [K B^T, B 0]") {
  const SparseStiffness B = Eigen::MatrixXd(Eigen::RowVector4d(1, 2, 3, 4)).sparseView();
  const Eigen::MatrixXd all = with_multipliers(chain(), B);
  CHECK(all.topLeftCorner(4, 4) == Eigen::MatrixXd(chain()));
  CHECK(all.row(4).head(4) == Eigen::RowVector4d(1, 2, 3, 4));
  CHECK(all.col(4).head(4) == Eigen::Vector4d(1, 2, 3, 4));
  CHECK(all(4, 4) == 0);
}

TEST_CASE("conditions: a loose body and contradictions are found") {
  CHECK_THROWS_AS(constrained_solution(chain(), force, {}), NumericalError);
  const SparseStiffness B = Eigen::MatrixXd{{1, 0, 0, 0}, {2, 0, 0, 0}}.sparseView();
  CHECK_THROWS_AS(solution_with_multipliers(chain(), B, force, Eigen::Vector2d(0, 1)), NumericalError);
}
