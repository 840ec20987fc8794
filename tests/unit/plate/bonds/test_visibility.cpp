#include <catch2/catch.hpp>

#include "tests/unit/plate/held_plate.hpp"

using namespace plate;
using namespace held_plate;

namespace {

/// Points along pq, ends included.
template <typename Test>
bool any_on(const Point& p, const Point& q, const Test& test) {
  for (int i = 0; i <= 400; ++i)
    if (test(Point(p + (q - p) * (i / 400.0)))) return true;
  return false;
}

}  // namespace

TEST_CASE("sees: no bond through a hole") {
  auto outline = geometry::rectangle(0, 0, 12, 12);
  outline.holes.push_back(geometry::Circle{{6.1, 5.8}, 1.3, "hole"});
  const Boundary b = held({}, outline);
  const auto bonded = sees(b, outline, 3.015);
  std::size_t through = 0, past = 0;
  for (std::uint32_t j = 0; j < b.lattice.size(); ++j)
    for (std::uint32_t k = 0; k < j; ++k) {
      if ((b.lattice[k] - b.lattice[j]).norm() > 3.02) continue;
      const auto within = [&](double radius) {
        return any_on(b.lattice[k], b.lattice[j],
                      [&](const Point& x) { return (x - Point(6.1, 5.8)).norm() < radius; });
      };
      const bool enters = within(1.3 - 1e-9), clear = !within(1.3 + 1e-4);
      if (enters) CHECK_FALSE(bonded(k, j));
      if (clear) CHECK(bonded(k, j));
      through += enters, past += clear;
    }
  CHECK(through > 10);
  CHECK(past > 1000);
}

TEST_CASE("sees: no bond past a re-entrant corner") {
  const auto outline = angle_shape();
  const Boundary b = held({}, outline);
  const auto bonded = sees(b, outline, 3.015);
  std::size_t through = 0, inside = 0;
  for (std::uint32_t j = 0; j < b.lattice.size(); ++j)
    for (std::uint32_t k = 0; k < j; ++k) {
      if ((b.lattice[k] - b.lattice[j]).norm() > 3.02) continue;
      const bool leaves =
          any_on(b.lattice[k], b.lattice[j], [](const Point& x) { return x.x() > 5 + 1e-9 && x.y() > 4 + 1e-9; });
      CHECK(bonded(k, j) == !leaves);
      ++(leaves ? through : inside);
    }
  CHECK(through == 3);
  CHECK(inside > 500);
}

TEST_CASE("sees: images across their own side alone, never each other") {
  const auto outline = angle_shape();
  const Boundary b = held({{SupportKind::clamped, {"step", "wall", "east"}, {}}}, outline);
  const auto bonded = sees(b, outline, 3.015);
  std::size_t seen = 0, images = 0;
  for (std::uint32_t j = std::uint32_t(b.cloud.plate_points); j < b.lattice.size(); ++j)
    for (std::uint32_t k = 0; k < j; ++k) {
      const Point &p = b.lattice[k], &q = b.lattice[j];
      if ((p - q).norm() > 3.02) continue;
      if (!b.is_plate(k)) {
        CHECK_FALSE(bonded(k, j));
        ++images;
        continue;
      }
      const auto& image = b.fictitious[j - b.cloud.plate_points];
      if (!bonded(k, j) || image.sides[1] >= 0) continue;
      ++seen;
      const Side& side = b.sides[std::size_t(image.sides[0])];
      const int axis = side.edge.from.x() == side.edge.to.x() ? 0 : 1;
      const Point hit = p + (q - p) * (side.edge.from[axis] - p[axis]) / (q[axis] - p[axis]);
      const double low = std::min(side.edge.from[1 - axis], side.edge.to[1 - axis]);
      const double high = std::max(side.edge.from[1 - axis], side.edge.to[1 - axis]);
      CHECK(hit[1 - axis] >= low - 1e-9);
      CHECK(hit[1 - axis] <= high + 1e-9);
    }
  CHECK(seen > 100);
  CHECK(images > 100);
}

TEST_CASE("sees: inside a mirrored rectangle every point has its full family") {
  auto d = small_plate::spaced(1);
  const auto m = small_plate::model(geometry::rectangle(0, 0, 8, 7), {all_round(SupportKind::clamped)}, d);
  const auto& families = m.plate.families();
  for (std::size_t k = 0; k < m.boundary.cloud.plate_points; ++k) CHECK(families[k].size() == 28);
}

TEST_CASE("any_image asks for the bond and its reflections") {
  const Boundary b = held({{SupportKind::clamped, {"left", "bottom"}, {}}});
  const auto asked = [&](const Point& p, const Point& q) {
    std::vector<std::pair<Point, Point>> all;
    CHECK_FALSE(b.any_image(*point_at(b, p), *point_at(b, q), [&](const Point& u, const Point& v) {
      all.emplace_back(u, v);
      return false;
    }));
    return all;
  };
  CHECK(asked({1.5, 1.5}, {2.5, 1.5}).size() == 1);
  const auto edge = asked({0.5, 4.5}, {-1.5, 4.5});
  REQUIRE(edge.size() == 2);
  CHECK(edge[1].first == Point(-0.5, 4.5));
  CHECK(edge[1].second == Point(1.5, 4.5));
  const auto corner = asked({0.5, 0.5}, {-0.5, -1.5});
  REQUIRE(corner.size() == 4);
  CHECK(corner[3].first == Point(-0.5, -0.5));
  CHECK(corner[3].second == Point(0.5, 1.5));
}
