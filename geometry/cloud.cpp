#include "geometry/cloud.hpp"

#include <cmath>
#include <limits>

namespace geometry {
namespace {

constexpr double steps = 1 << 20;  // per spacing

double rounded(double u) {
  return std::round(u * steps) / steps;
}

Polygon to_lattice(Polygon polygon, const LatticeUnits& units) {
  for (Point& v : polygon.vertices) v = units.to_lattice(v);
  return polygon;
}

Circle to_lattice(const Circle& circle, const LatticeUnits& units) {
  return {units.to_lattice(circle.centre), rounded(circle.radius / units.spacing), circle.name};
}

}  // namespace

Point LatticeUnits::to_lattice(const Point& x) const {
  const Point u = (x - origin) / spacing;
  return {rounded(u.x()), rounded(u.y())};
}

Outline to_lattice(const Outline& outline, const LatticeUnits& units) {
  Outline result{to_lattice(outline.outer, units), {}};
  for (const Hole& hole : outline.holes)
    result.holes.push_back(std::visit([&](const auto& shape) -> Hole { return to_lattice(shape, units); }, hole));
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
