#include "plate/formulation/constraints.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/plate/small_plate.hpp"

using plate::Constraints;
using plate::Forces;
using plate::State;

namespace {

constexpr Eigen::Index points = 4;  // 12 degrees of freedom

/// P column by column: the action on unit vectors.
Eigen::MatrixXd action(const Constraints& constraints) {
  Eigen::MatrixXd P(3 * points, 3 * points);
  for (Eigen::Index n = 0; n < P.cols(); ++n) {
    State unit = State::Zero(3, points);
    plate::at_dof(unit, std::size_t(n)) = 1;
    constraints.impose(unit);
    P.col(n) = unit.reshaped();
  }
  return P;
}

Constraints several() {
  Constraints c;
  c.fix(0);
  c.tie(1, {{2, 0.5}});  // chain 1 -> 2 -> 3
  c.tie(2, {{3, -3}});
  c.tie(4, {{0, 7}});  // follows a fixed one
  c.tie(5, {{3, 2}});  // two followers of one leader
  c.tie(5, {{8, 9}});  // held twice: the first counts
  c.tie(6, {{7, 1}});  // ring
  c.tie(7, {{6, 1}});
  c.tie(9, {{6, 1}});  // leads into the ring
  c.resolve();
  return c;
}

}  // namespace

TEST_CASE("chains end at a free leader, fixed leaders and rings hold at zero") {
  const Constraints c = several();
  CHECK(c.fixed() == std::vector<std::uint32_t>{0, 4, 6, 7, 9});
  REQUIRE(c.ties().size() == 3);
  const auto is = [&](std::size_t i, std::uint32_t follower, std::uint32_t leader, double factor) {
    CHECK(c.ties()[i].follower == follower);
    CHECK(c.ties()[i].leader == leader);
    CHECK(c.ties()[i].factor == factor);
  };
  is(0, 1, 3, -1.5);
  is(1, 2, 3, -3);
  is(2, 5, 3, 2);
  for (std::uint32_t dof = 0; dof < 12; ++dof)
    CHECK(c.held(dof) ==
          (dof == 0 || dof == 1 || dof == 2 || dof == 4 || dof == 5 || dof == 6 || dof == 7 || dof == 9));
}

TEST_CASE("a fixed degree of freedom that is also tied stays fixed") {
  Constraints c;
  c.tie(3, {{5, 1}});
  c.fix(3);
  c.resolve();
  CHECK(c.ties().empty());
  CHECK(c.fixed() == std::vector<std::uint32_t>{3});
}

TEST_CASE("impose is a projection; a free state stays as it is") {
  const Constraints c = several();
  State u = small_plate::random_state(points, 3);
  const State before = u;
  c.impose(u);
  CHECK(plate::at_dof(u, std::size_t(0)) == 0);
  CHECK(plate::at_dof(u, std::size_t(1)) == -1.5 * plate::at_dof(before, std::size_t(3)));
  CHECK(plate::at_dof(u, std::size_t(8)) == plate::at_dof(before, std::size_t(8)));
  State again = u;
  c.impose(again);
  CHECK(again == u);
}

TEST_CASE("folds are the transposes that they say") {
  const Constraints c = several();
  // P takes its values from the free degrees of freedom alone
  Eigen::MatrixXd P = action(c);
  for (std::uint32_t dof = 0; dof < 12; ++dof)
    if (c.held(dof)) P.col(dof).setZero();
  const Forces f = small_plate::random_state(points, 4);

  Forces folded = f, absolute = f, diagonal = f;
  c.fold(folded);
  c.fold_absolute(absolute);
  c.fold_diagonal(diagonal);
  const Eigen::VectorXd flat = f.reshaped();
  const Eigen::MatrixXd square = P.transpose() * flat.asDiagonal() * P;
  CHECK((folded.reshaped() - P.transpose() * flat).norm() < 1e-14);               // measured: 4e-16
  CHECK((absolute.reshaped() - P.cwiseAbs().transpose() * flat).norm() < 1e-14);  // measured: 2e-16
  CHECK((diagonal.reshaped() - square.diagonal()).norm() < 1e-14);                // measured: 1e-15
}

TEST_CASE("a symmetric stiffness stays symmetric") {
  const Constraints c = several();
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(
      12, 12, [](Eigen::Index i, Eigen::Index j) { return std::sin(double(3 * i + 5 * j)); });
  const Eigen::MatrixXd K = half + half.transpose();
  Eigen::MatrixXd reduced(12, 12);
  for (Eigen::Index n = 0; n < 12; ++n) {
    State unit = State::Zero(3, points);
    if (!c.held(static_cast<std::uint32_t>(n))) plate::at_dof(unit, std::size_t(n)) = 1;
    c.impose(unit);
    Forces f(3, points);
    f.reshaped() = K * unit.reshaped();
    c.fold(f);
    reduced.col(n) = f.reshaped();
  }
  CHECK(reduced.norm() > 1);
  CHECK((reduced - reduced.transpose()).norm() < 1e-14);  // measured: 1e-15
}
