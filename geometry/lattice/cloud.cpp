#include "geometry/lattice/cloud.hpp"

#include <cmath>
#include <limits>

namespace geometry {
namespace {

constexpr double steps = 1 << 20;  // per spacing

double rounded(double u) {
  return std::round(u * steps) / steps;
}

}  // namespace

Point LatticeUnits::to_lattice(const Point& x) const {
  const Point u = (x - origin) / spacing;
  return {rounded(u.x()), rounded(u.y())};
}

Outline placed(const Outline& outline, const std::function<Point(const Point&)>& place, double scale) {
  const auto polygon = [&](Polygon shape) {
    for (Point& v : shape.vertices) v = place(v);
    return shape;
  };
  Outline result{polygon(outline.outer), {}};
  for (const Hole& hole : outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole))
      result.holes.push_back(Circle{place(circle->centre), scale * circle->radius, circle->name});
    else
      result.holes.push_back(polygon(std::get<Polygon>(hole)));
  return result;
}

Outline to_lattice(const Outline& outline, const LatticeUnits& units) {
  auto result = placed(
      outline, [&](const Point& x) { return units.to_lattice(x); }, 1 / units.spacing);
  for (Hole& hole : result.holes)
    if (auto* circle = std::get_if<Circle>(&hole)) circle->radius = rounded(circle->radius);
  return result;
}

std::vector<CrackPath> to_lattice(const std::vector<CrackPath>& paths, const LatticeUnits& units) {
  std::vector<CrackPath> result = paths;
  for (CrackPath& path : result)
    for (Point& v : path.vertices) v = units.to_lattice(v);
  return result;
}

std::size_t nearest_plate_point(const Cloud& cloud, const Point& x) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < cloud.plate_points; ++k) {
    const double squared = (cloud.positions[k] - x).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = k;
  }
  return nearest;
}

}  // namespace geometry
