#include <algorithm>
#include <map>

#include "geometry/cells/drawn_cells.hpp"
#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/predicates.hpp"
#include "tests/catch.hpp"
#include "tests/unit/geometry/random_plates.hpp"

using namespace geometry;

namespace {

struct Drawn {
  Cloud cloud;
  std::vector<Point> lattice;
  DrawnCells cells;

  Point at(std::uint32_t k) const {
    return k < cloud.plate_points ? cloud.positions[k] : cells.corners[k - cloud.plate_points].position;
  }
  template <typename Visit>
  void for_cells(const Visit& visit) const {
    for (const auto& square : cells.squares) visit(std::vector<std::uint32_t>(square.begin(), square.end()));
    for (const auto& triangle : cells.triangles) visit(std::vector<std::uint32_t>(triangle.begin(), triangle.end()));
  }
};

Drawn drawn(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing) {
  Drawn result{lattice(outline, spacing), {}, {}};
  for (const auto& x : result.cloud.positions)
    result.lattice.push_back((result.cloud.units.to_units(x).array() - 0.5).round() + 0.5);
  result.cells = drawn_cells(outline, cracks, result.cloud.units, result.lattice);
  return result;
}

Drawn drawn(const random_plates::Plate& plate, double spacing) {
  return drawn(plate.outline, random_plates::paths(plate), spacing);
}

/// Area and length of a circle as the polygon of the corners that lie on it.
std::pair<double, double> polygon_on(const Circle& circle, const Drawn& plate) {
  std::map<double, Point> by_angle;
  for (const auto& corner : plate.cells.corners) {
    const Point x = corner.position - circle.centre;
    if (std::abs(x.norm() - circle.radius) < 1e-9) by_angle[std::atan2(x.y(), x.x())] = x;
  }
  std::vector<Point> ring;
  for (const auto& [angle, x] : by_angle)
    if (ring.empty() || (x - ring.back()).norm() > 1e-12) ring.push_back(x);
  double length = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) length += (next(ring, i) - ring[i]).norm();
  return {signed_area(ring), length};
}

/// The plate is filled to its edges, both faces of cracks are borders, and nothing else is.
void check_drawn(const random_plates::Plate& plate, double spacing, double rounding) {
  const auto found = drawn(plate, spacing);
  double wanted = area(plate.outline), rim = 0;
  for (const auto& edge : straight_edges(plate.outline)) rim += (edge.to - edge.from).norm();
  for (const auto& crack : plate.cracks) rim += 2 * length(crack);
  for (const auto& hole : plate.outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole)) {
      const auto [inside, about] = polygon_on(*circle, found);
      wanted += std::numbers::pi * circle->radius * circle->radius - inside, rim += about;
      CHECK(about == Approx(2 * std::numbers::pi * circle->radius).epsilon(0.002));
    }
  double sum = 0, least = 1, border = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  std::vector<char> in_cell(found.cloud.plate_points, 0);
  found.for_cells([&](const auto& cell) {
    Ring ring;
    for (const auto k : cell) {
      ring.push_back(found.at(k) - found.cloud.units.origin);
      if (k < in_cell.size()) in_cell[k] = 1;
    }
    sum += signed_area(ring), least = std::min(least, signed_area(ring));
    for (std::size_t i = 0; i < cell.size(); ++i) ++sides[std::minmax(cell[i], cell[(i + 1) % cell.size()])];
  });
  for (const auto& [side, cells] : sides) {
    CHECK(cells <= 2);
    if (cells == 1) border += (found.at(side.first) - found.at(side.second)).norm();
  }
  CHECK(least > 0);
  CHECK(sum == Approx(wanted).epsilon(rounding));
  CHECK(border == Approx(rim).epsilon(10 * rounding));
  CHECK(std::ranges::count(in_cell, 0) == 0);
  for (const auto& corner : found.cells.corners) {
    CHECK_FALSE(corner.seen.empty());
    for (const auto k : corner.seen) CHECK(k < found.cloud.plate_points);
  }
}

}  // namespace

TEST_CASE("drawn cells fill any plate exactly and are open along its cracks") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto plate = random_plates::Maker(seed).plate();
    CAPTURE(seed);
    for (const double spacing : {0.2, 0.07}) check_drawn(plate, spacing, 1e-12);
  }
}

TEST_CASE("drawn cells fill plates that are turned and far from the origin") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    random_plates::Maker maker(seed);
    const auto plate = random_plates::moved(maker.plate(), maker.uniform(0, 6), {1e3, -7e2});
    CAPTURE(seed);
    check_drawn(plate, 0.1, 1e-11);
  }
}

TEST_CASE("drawn cells: cracks along lines of points, across points and between them") {
  for (const double y : {2.5, 3.0, 3.5, 3.001, 3.4999999})
    for (const double end : {2.5, 2.7, 3.0, 3.5, 8.0}) {
      CAPTURE(y, end);
      check_drawn({rectangle(0, 0, 8, 6), {{{0, y}, {end, y}}}}, 1, 1e-12);
      check_drawn({rectangle(0, 0, 8, 6), {{{1.5, y}, {std::min(end + 0.1, 8.0), y}}, {{4, 0}, {4, 1.5}}}}, 1, 1e-12);
    }
  for (const double shift : {0.0, 0.25, 0.5, 1e-7, 1e-10}) {
    CAPTURE(shift);
    check_drawn({rectangle(0, 0, 8, 8), {{{1.5, 1.5 + shift}, {6.5, 6.5 + shift}}}}, 1, 1e-11);
  }
}

TEST_CASE("drawn cells: a plate that is no whole number of spacings is drawn whole") {
  for (const double side : {7.0, 7.3, 7.5, 7.9}) {
    CAPTURE(side);
    check_drawn({rectangle(0, 0, side, 5), {}}, 1, 1e-12);
  }
}

TEST_CASE("drawn cells: a point on a crack is on the side of +y, and of +x where that is level") {
  const auto plate = rectangle(0, 0, 6, 6);
  const std::vector<Polyline> cracks{{{0, 2.5}, {6, 2.5}}, {{2.5, 0}, {2.5, 6}}, {{0, 6}, {6, 0}}};
  for (const auto& crack : cracks) {
    const auto found = drawn(plate, {{crack, End::mouth, End::mouth}}, 1);
    CAPTURE(crack.front().transpose(), crack.back().transpose());
    std::size_t on_crack = 0;
    found.for_cells([&](const auto& cell) {
      Point middle(0, 0);
      for (const auto k : cell) middle += found.at(k) / double(cell.size());
      for (const auto k : cell) {
        if (k >= found.cloud.plate_points || distance(crack, found.at(k)) > 1e-9) continue;
        ++on_crack;
        const Point along = crack.back() - crack.front();
        CHECK(cross(along, middle - crack.front()) * cross(along, Point(1e-3, 1e-6)) > 0);
      }
    });
    CHECK(on_crack > 10);
  }
}

TEST_CASE("drawn cells: a corner sees points of its own side of a crack") {
  const auto plate = rectangle(0, 0, 8, 8);
  const CrackPath crack{{{0, 1.3}, {8, 6.1}}, End::mouth, End::mouth};
  const auto found = drawn(plate, {crack}, 1);
  const Point along = crack.vertices[1] - crack.vertices[0];
  const auto above = [&](const Point& x) { return cross(along, x - crack.vertices[0]) > 0; };
  std::size_t faces = 0;
  found.for_cells([&](const auto& cell) {
    Point middle(0, 0);
    for (const auto k : cell) middle += found.at(k) / double(cell.size());
    for (const auto k : cell)
      if (k >= found.cloud.plate_points)
        for (const auto seen : found.cells.corners[k - found.cloud.plate_points].seen) {
          ++faces;
          CHECK(above(found.at(seen)) == above(middle));
        }
  });
  CHECK(faces > 100);
}
