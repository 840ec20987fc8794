#include "plate/bonds/mesh.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using geometry::Point;

namespace {

Mesh mesh_of(const small_plate::Model& m, std::vector<double> cut = {}) {
  return mesh(m.boundary, m.plate.families(), std::move(cut), small_plate::section.thickness);
}

Mesh mesh_of(const geometry::Outline& outline, const std::vector<Support>& supports = {},
             const std::vector<geometry::CrackPath>& cracks = {}) {
  return mesh_of(small_plate::model(outline, supports, small_plate::spaced(1), cracks));
}

template <std::size_t N>
double signed_area(const Mesh& mesh, const std::array<std::uint32_t, N>& cell) {
  double twice = 0;
  for (std::size_t i = 0; i < N; ++i) {
    const Point &a = mesh.positions[cell[i]], &b = mesh.positions[cell[(i + 1) % N]];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

}  // namespace

TEST_CASE("mesh: a rectangle is all quadrilaterals, counter-clockwise, between neighbours") {
  const Mesh found = mesh_of(geometry::rectangle(0, 0, 7, 5), {{SupportKind::clamped, {"left"}, {}}});
  CHECK(found.positions.size() == 35);  // no fictitious points
  CHECK(found.areas.size() == 35);
  CHECK(found.quads.size() == 6 * 4);
  CHECK(found.triangles.empty());
  CHECK(found.spacing == 1);
  CHECK(found.thickness == small_plate::section.thickness);
  std::set<std::array<std::uint32_t, 4>> different;
  for (auto quad : found.quads) {
    CHECK(signed_area(found, quad) == 1);
    std::sort(quad.begin(), quad.end());
    different.insert(quad);
  }
  CHECK(different.size() == found.quads.size());
}

TEST_CASE("mesh: the cut share is passed on") {
  const auto m = small_plate::model(geometry::rectangle(0, 0, 2, 1), {}, small_plate::spaced(1));
  CHECK(mesh_of(m, {0.25, 0.5}).cut == std::vector<double>{0.25, 0.5});
}

TEST_CASE("mesh: a crack between rows is a gap one cell wide") {
  const geometry::CrackPath crack{{{0, 3}, {8, 3}}, geometry::End::mouth, geometry::End::mouth};
  const Mesh found = mesh_of(geometry::rectangle(0, 0, 8, 6), {}, {crack});
  CHECK(found.quads.size() == 7 * 5 - 7);
  CHECK(found.triangles.empty());
  for (const auto& quad : found.quads) CHECK((found.positions[quad[0]].y() < 3) == (found.positions[quad[2]].y() < 3));
}

TEST_CASE("mesh: a slanted crack leaves triangles on both sides") {
  const geometry::CrackPath crack{{{-1, -1.3}, {9, 8.7}}, geometry::End::mouth, geometry::End::mouth};  // y = x - 0.3
  const Mesh found = mesh_of(geometry::rectangle(0, 0, 8, 8), {}, {crack});
  // the line passes below the points (i, i): cells on the diagonal and the next one below are cut
  const auto above = [&](std::uint32_t k) { return found.positions[k].y() > found.positions[k].x() - 0.3; };
  CHECK_FALSE(found.triangles.empty());
  for (const auto& cell : found.triangles) {
    CHECK(std::abs(signed_area(found, cell)) == 0.5);
    CHECK(above(cell[0]) == above(cell[1]));
    CHECK(above(cell[0]) == above(cell[2]));
  }
  for (const auto& cell : found.quads)
    for (int i : {1, 2, 3}) CHECK(above(cell[0]) == above(cell[std::size_t(i)]));
}

TEST_CASE("mesh: triangles run counter-clockwise, at the edge of a hole") {
  auto outline = geometry::rectangle(0, 0, 12, 12);
  outline.holes.push_back(geometry::Circle{{6, 6}, 2.6, "hole"});
  const Mesh found = mesh_of(outline);
  REQUIRE_FALSE(found.triangles.empty());
  for (const auto& cell : found.triangles) CHECK(signed_area(found, cell) == 0.5);
  for (const auto& quad : found.quads) {
    const Point centre = (found.positions[quad[0]] + found.positions[quad[2]]) / 2;
    CHECK((centre - Point(6, 6)).norm() > 2);
  }
}

TEST_CASE("mesh: all three-point corners of a hole become triangles", "") {
  // a point missing in the middle of 5 x 5: the four cells around it lose one corner each
  auto outline = geometry::rectangle(0, 0, 5, 5);
  outline.holes.push_back(geometry::Circle{{2.5, 2.5}, 0.4, "hole"});
  const Mesh found = mesh_of(outline);
  CHECK(found.positions.size() == 24);
  CHECK(found.quads.size() == 16 - 4);
  CHECK(found.triangles.size() == 4);  // 3 where cells without their lower left point are not looked at
}
