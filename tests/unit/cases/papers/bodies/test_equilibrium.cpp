#include "cases/papers/bodies/equilibrium.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

namespace {

/// Two springs in a row, 1 and 2, on three points.
plate::SparseStiffness two_springs() {
  Eigen::Matrix3d K{{1, -1, 0}, {-1, 3, -2}, {0, -2, 2}};
  return K.sparseView();
}

}  // namespace

TEST_CASE("equilibrium: held values and their reactions, the same by multipliers") {
  const Eigen::Vector3d f(0, 0, 4);
  const auto held = bb::constrained_solution(two_springs(), f, {{0, 0.5}});
  CHECK((held.values - Eigen::Vector3d(0.5, 4.5, 6.5)).norm() < 1e-12);
  CHECK(held.reactions[0] == Approx(-4));
  plate::SparseStiffness B(1, 3);
  B.insert(0, 0) = 1;
  const auto multiplied = bb::solution_with_multipliers(two_springs(), B, f, Eigen::VectorXd::Constant(1, 0.5));
  CHECK((multiplied.values - held.values).norm() < 1e-12);
  CHECK(multiplied.multipliers[0] == Approx(4));
}

TEST_CASE("equilibrium: bodies of one to three dimensions have a surface node per outer face") {
  CHECK(bb::box_body({5}, 3).surface.size() == 2);
  CHECK(bb::box_body({5, 4}, 3).surface.size() == 18);
  const auto box = bb::box_body({3, 4, 5}, 2);
  CHECK(box.real == 60);
  CHECK(box.surface.size() == 2 * (12 + 20 + 15));
}
