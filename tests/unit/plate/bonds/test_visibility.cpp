#include <map>
#include <numbers>

#include "tests/catch.hpp"
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

TEST_CASE("sees: a bond that leaves a held polygon meets one image of the place where it ends") {
  const int sides = GENERATE(3, 5, 8, 24, 48, 96);
  geometry::Outline outline;
  Support clamp{SupportKind::clamped, {}, {}};
  for (int s = 0; s < sides; ++s) {
    const double angle = 2 * std::numbers::pi * (s + 0.13) / sides;
    outline.outer.vertices.emplace_back(6.3 * std::cos(angle), 6.3 * std::sin(angle));
    outline.outer.edge_names.push_back("side" + std::to_string(s));
    clamp.edges.push_back(outline.outer.edge_names.back());
  }
  outline = geometry::to_lattice(outline, geometry::lattice(outline, 1).units);
  const Boundary b = held({clamp}, outline);
  const auto bonded = sees(b, outline, 3.015);
  std::map<std::pair<std::uint32_t, std::pair<long, long>>, int> met;
  for (std::uint32_t j = std::uint32_t(b.cloud.plate_points); j < b.lattice.size(); ++j)
    for (std::uint32_t k = 0; k < b.cloud.plate_points; ++k)
      if (const Point& v = b.lattice[j]; (b.lattice[k] - v).norm() < 3.015)
        met[{k, {std::lround(2 * v.x()), std::lround(2 * v.y())}}] += bonded(k, j);
  CHECK(met.size() > 50);
  for (const auto& [bond, images] : met) {
    CAPTURE(sides, b.lattice[bond.first].transpose(), bond.second.first, bond.second.second);
    CHECK(images == 1);
  }
  // and no place without an image: every family is full
  std::map<std::uint32_t, int> family;
  for (const auto& [bond, images] : met) family[bond.first] += images;
  for (std::uint32_t k = 0; k < b.cloud.plate_points; ++k) {
    int within = 0;
    for (std::uint32_t j = 0; j < b.cloud.plate_points; ++j)
      within += j != k && (b.lattice[k] - b.lattice[j]).norm() < 3.015;
    CAPTURE(sides, b.lattice[k].transpose());
    CHECK(within + family[k] == 28);
  }
  CHECK(b.warnings.size() == 1);
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
