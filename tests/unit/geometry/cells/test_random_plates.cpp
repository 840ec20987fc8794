#include <catch2/catch.hpp>

#include "geometry/cells/tessellation.hpp"
#include "geometry/shape/predicates.hpp"
#include "tests/unit/geometry/random_plates.hpp"

using namespace geometry;

namespace {

struct Measures {
  double area = 0, least_double_area = 1, least_angle = 180;  // [degrees]
};

Measures measures(const Tessellation& cells) {
  Measures result;
  const auto add = [&](const std::array<std::uint32_t, 3>& corners) {
    const std::array<Point, 3> x{cells.local[corners[0]], cells.local[corners[1]], cells.local[corners[2]]};
    const double twice = cross(x[1] - x[0], x[2] - x[0]);
    result.area += twice / 2;
    result.least_double_area = std::min(result.least_double_area, twice);
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = x[(i + 1) % 3] - x[i], b = x[(i + 2) % 3] - x[i];
      result.least_angle = std::min(result.least_angle, std::atan2(cross(a, b), a.dot(b)) * 180 / std::numbers::pi);
    }
  };
  for (const auto& triangle : cells.triangles) add(triangle);
  for (const auto& [a, b, c, d] : cells.squares) add({a, b, c}), add({a, c, d});
  return result;
}

/// Circles count as the polygons that their borders are.
double wanted_area(const random_plates::Plate& plate, const Tessellation& cells) {
  double result = area(plate.outline);
  for (const auto& hole : plate.outline.holes) {
    const auto* circle = std::get_if<Circle>(&hole);
    if (!circle) continue;
    result += std::numbers::pi * circle->radius * circle->radius;
    for (const auto& border : cells.borders)
      if (border.edge >= 0 && cells.names[std::size_t(border.edge)] == circle->name)
        result += cross(cells.positions[border.from] - circle->centre, cells.positions[border.to] - circle->centre) / 2;
  }
  return result;
}

/// How far the ends of borders are from the straight curves that they belong to.
double furthest_off(const random_plates::Plate& plate, const Tessellation& cells) {
  double result = 0;
  const auto edges = straight_edges(plate.outline);
  for (const auto& border : cells.borders)
    for (const auto k : {border.from, border.to}) {
      double nearest = border.edge == Curves::crack ? 10 : 0;
      for (const auto& crack : plate.cracks)
        if (border.edge == Curves::crack) nearest = std::min(nearest, distance(crack, cells.positions[k]));
      bool first = true;
      for (const auto& edge : edges)
        if (border.edge >= 0 && edge.name == cells.names[std::size_t(border.edge)]) {
          const double off = distance({edge.from, edge.to}, cells.positions[k]);
          nearest = first ? off : std::min(nearest, off), first = false;
        }
      result = std::max(result, nearest);
    }
  return result;
}

double crack_length(const Tessellation& cells) {
  double result = 0;
  for (const auto& border : cells.borders)
    if (border.edge == Curves::crack) result += (cells.positions[border.to] - cells.positions[border.from]).norm() / 2;
  return result;
}

void check(const random_plates::Plate& plate, const Tessellation& cells, double rounding) {
  const auto found = measures(cells);
  INFO(cells.positions.size() << " points, least angle " << found.least_angle);
  CHECK(found.least_double_area > 0);
  CHECK(found.area == Approx(wanted_area(plate, cells)).epsilon(rounding));
  CHECK(furthest_off(plate, cells) < rounding);
  double wanted = 0;
  for (const auto& crack : plate.cracks)
    for (std::size_t i = 0; i + 1 < crack.size(); ++i) wanted += (crack[i + 1] - crack[i]).norm();
  CHECK(crack_length(cells) == Approx(wanted).margin(10 * rounding));
  for (const auto& edge : straight_edges(plate.outline)) {
    double length = 0;
    for (const auto& border : cells.borders)
      if (border.edge >= 0 && cells.names[std::size_t(border.edge)] == edge.name)
        length += (cells.positions[border.to] - cells.positions[border.from]).norm();
    CHECK(length == Approx(edge_length(plate.outline, edge.name)).epsilon(10 * rounding));
  }
}

const Grading by_tips{0.03, 0.1, 0.3}, by_fine_tips{1e-4, {}, 0.5};

/// A crack of length 0.6 in the middle of a square plate of side 2.
Tessellation inclined(double degrees, double at_tips, double growth) {
  const double angle = degrees * std::numbers::pi / 180;
  const Point end(0.3 * std::cos(angle), 0.3 * std::sin(angle));
  const auto plate = rectangle(-1, -1, 1, 1);
  return tessellation(plate, crack_paths(plate, {Polyline{Point(-end), end}}, 1e-9), 0.2, {}, {at_tips, {}, growth});
}

}  // namespace

TEST_CASE("cells of a lattice fill any plate, and borders lie on its curves") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const auto plate = random_plates::Maker(seed).plate();
    CAPTURE(seed);
    for (const double spacing : {0.2, 0.07})
      check(plate, tessellation(plate.outline, random_plates::paths(plate), spacing, {}, {}),
            1e-12);  // measured: 2e-14
  }
}

TEST_CASE("graded cells fill any plate, and borders lie on its curves") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const auto plate = random_plates::Maker(seed).plate();
    CAPTURE(seed);
    const auto& grading = seed % 2 == 0 ? by_tips : by_fine_tips;
    check(plate, tessellation(plate.outline, random_plates::paths(plate), 0.3, {}, grading), 1e-12);  // measured: 2e-14
  }
}

TEST_CASE("cells fill any plate that is turned and far from the origin") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    random_plates::Maker maker(seed);
    const auto plate = random_plates::moved(maker.plate(), maker.uniform(0, 6), {1e5, -7e4});
    CAPTURE(seed);
    const Grading grading = seed % 3 == 0 ? by_tips : Grading{};
    check(plate, tessellation(plate.outline, random_plates::paths(plate), 0.1, {}, grading), 1e-9);  // measured: 6e-12
  }
}

TEST_CASE("points may be a million times closer together at tips, at any angle") {
  for (const double ratio : {1e2, 1e3, 1e4, 1e5, 1e6})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const double at_tips = 2 / ratio;
      const auto cells = inclined(degrees, at_tips, 0.4);
      CAPTURE(ratio, degrees);
      const auto found = measures(cells);
      CHECK(found.area == Approx(4).epsilon(1e-12));
      CHECK(found.least_angle > 15);  // measured: 18
      CHECK(crack_length(cells) == Approx(0.6).epsilon(1e-12));
      CHECK(cells.positions.size() < 1500);  // measured: 950
    }
}

TEST_CASE("about a tip the triangles are nearly equal") {
  for (const double at_tips : {0.02, 1e-4})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const auto cells = inclined(degrees, at_tips, 0.2);
      const double angle = degrees * std::numbers::pi / 180;
      const Point tip(0.3 * std::cos(angle), 0.3 * std::sin(angle));
      std::size_t fan = 0;
      double least = 180, largest = 0, shortest = 1, longest = 0;
      for (const auto& triangle : cells.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          if ((cells.positions[triangle[i]] - tip).norm() > 1e-3 * at_tips) continue;
          const Point a = cells.positions[triangle[(i + 1) % 3]] - tip,
                      b = cells.positions[triangle[(i + 2) % 3]] - tip;
          const double turn = std::atan2(cross(a, b), a.dot(b)) * 180 / std::numbers::pi;
          least = std::min(least, turn), largest = std::max(largest, turn), ++fan;
          shortest = std::min(shortest, a.norm()), longest = std::max(longest, a.norm());
        }
      CAPTURE(at_tips, degrees, fan, least, largest, shortest / at_tips, longest / at_tips);
      CHECK(fan >= 5);
      CHECK(fan <= 8);
      CHECK(least > 35);
      CHECK(largest < 80);
      CHECK(shortest > 0.8 * at_tips);
      CHECK(longest < 1.4 * at_tips);
    }
}

TEST_CASE("points on the faces of a crack are seen on their side at any scale") {
  for (const double at_tips : {1e-2, 1e-4, 1e-6})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const auto cells = inclined(degrees, at_tips, 0.4);
      const auto seen = seen_positions(cells);
      const double angle = degrees * std::numbers::pi / 180;
      const Point along(std::cos(angle), std::sin(angle));
      std::vector<char> face(seen.size(), 0);
      for (const auto& border : cells.borders)
        if (border.edge == Curves::crack) face[border.from] = face[border.to] = 1;
      int wrong = 0, count = 0;
      for (const auto& triangle : cells.triangles)
        for (const auto k : triangle) {
          if (!face[k] || std::abs(along.dot(cells.positions[k])) > 0.3 - 1e-9) continue;
          double sum = 0;  // of what is beside the crack in this cell
          for (const auto j : triangle) sum += cross(along, cells.positions[j]);
          ++count, wrong += sum * cross(along, seen[k]) <= 0;
          wrong += std::abs(cross(along, seen[k])) < 5e-7 * at_tips;
        }
      CHECK(count > 20);
      CHECK(wrong == 0);
    }
}
