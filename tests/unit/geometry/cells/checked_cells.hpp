#pragma once

#include "geometry/cells/tessellation.hpp"
#include "geometry/shape/predicates.hpp"
#include "tests/catch.hpp"
#include "tests/unit/geometry/random_plates.hpp"

/// Do cells fill their plate, and lie their borders on its curves?
namespace checked_cells {

using namespace geometry;

struct Measures {
  double area = 0, least_double_area = 1, least_angle = 180;  // [degrees]
};

inline Measures measures(const Tessellation& cells) {
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
inline double wanted_area(const random_plates::Plate& plate, const Tessellation& cells) {
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

/// Largest distance of the ends of borders from the straight curves that they belong to.
inline double furthest_off(const random_plates::Plate& plate, const Tessellation& cells) {
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

inline double crack_length(const Tessellation& cells) {
  double result = 0;
  for (const auto& border : cells.borders)
    if (border.edge == Curves::crack) result += (cells.positions[border.to] - cells.positions[border.from]).norm() / 2;
  return result;
}

inline void check(const random_plates::Plate& plate, const Tessellation& cells, double rounding) {
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

inline const Grading by_tips{0.03, 0.1, 0.3}, by_fine_tips{1e-4, {}, 0.5};

/// A crack of length 0.6 in the middle of a square plate of side 2.
inline Tessellation inclined(double degrees, double at_tips, double growth) {
  const double angle = degrees * std::numbers::pi / 180;
  const Point end(0.3 * std::cos(angle), 0.3 * std::sin(angle));
  const auto plate = rectangle(-1, -1, 1, 1);
  return tessellation(plate, crack_paths(plate, {Polyline{Point(-end), end}}, 1e-9), 0.2, {}, {at_tips, {}, growth});
}

}  // namespace checked_cells
