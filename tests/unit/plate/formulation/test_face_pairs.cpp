#include "plate/formulation/face_pairs.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace plate;
using geometry::Point;

TEST_CASE("faces of cracks: points at the same places, with the length of the crack between the tips' shares") {
  const Point from(-0.31, 0.02), to(0.33, 0.1);
  const auto cells = galerkin_plate::cells(geometry::rectangle(-1, -1, 1, 1), 0.1, {{from, to}});
  const auto pairs = facing_points(cells);
  REQUIRE(pairs.size() > 3);
  const Point along = (to - from).normalized(), normal(-along.y(), along.x());
  double length = 0;
  for (const auto& pair : pairs) {
    const auto left = pair.left.front().point, right = pair.right.front().point;
    CHECK(left != right);
    CHECK((cells.positions[left] - cells.positions[right]).norm() < 1e-12);
    CHECK(std::abs(pair.normal.dot(normal)) == Approx(1).epsilon(1e-3));
    length += pair.length;
  }
  // halves of the first and last piece belong to the tips
  CHECK(length > 0.75 * (to - from).norm());
  CHECK(length < (to - from).norm());
}

TEST_CASE("faces of cracks: jumps and the forces that do work on them") {
  const auto cells = galerkin_plate::cells(geometry::rectangle(-1, -1, 1, 1), 0.1, {{{-0.3, 0}, {0.3, 0}}});
  const auto state = galerkin_plate::random_state(cells.positions.size(), 4);
  const Eigen::Vector3d forces(0.3, -2, 0.7);
  for (const auto& pair : facing_points(cells)) {
    Forces on_points = zero_forces(cells.positions.size());
    pair.press(forces, on_points);
    CHECK(on_points.cwiseProduct(state).sum() == Approx(forces.dot(pair.jumps(state))));
    CHECK(pair.jumps(state)[1] == Approx(pair.opening(state)));
  }
}
