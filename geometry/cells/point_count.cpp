#include "geometry/cells/point_count.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geometry {
namespace {

constexpr double pi = std::numbers::pi;
const double packing = 2 / std::sqrt(3.0);  // of equilateral triangles

double perimeter(const Hole& hole) {
  if (const auto* circle = std::get_if<Circle>(&hole)) return 2 * pi * circle->radius;
  const auto& vertices = std::get<Polygon>(hole).vertices;
  double sum = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) sum += (vertices[(i + 1) % vertices.size()] - vertices[i]).norm();
  return sum;
}

/// Integral of 2 pi r / s^2 - 2 pi r / spacing^2 with s = least + growth r, until s is the spacing.
double about_tip(double least, double growth, double spacing) {
  const double r = (spacing - least) / growth;
  return 2 * pi / (growth * growth) * (std::log(spacing / least) + least / spacing - 1) -
         pi * r * r / spacing / spacing;
}

/// The same along a length of edge.
double along_edge(double least, double growth, double spacing) {
  return (1 / least - 1 / spacing) / growth - (spacing - least) / growth / spacing / spacing;
}

/// Integral of 1 / s^2 - 1 / spacing^2 across the points beside an edge with a layer.
double beside_layer(const Grading::Edge& edge, double growth, double spacing) {
  const double width = std::min(edge.layer, (spacing - edge.spacing) / growth), wide = edge.spacing + growth * width;
  return (1 / edge.spacing - 1 / wide) / growth - width / spacing / spacing + along_edge(wide, edge.beyond, spacing);
}

}  // namespace

double expected_points(const Outline& outline, const std::vector<Tip>& tips, double spacing, const Grading& grading) {
  double points = area(outline) / (spacing * spacing);
  if (!grading.at_tips && !grading.at_holes) return points;
  if (grading.at_tips && *grading.at_tips < spacing)
    points += double(tips.size()) * about_tip(*grading.at_tips, grading.growth, spacing);
  if (grading.at_holes && *grading.at_holes < spacing)
    for (const auto& hole : outline.holes)
      points += perimeter(hole) * along_edge(*grading.at_holes, grading.growth, spacing);
  if (grading.at_corners > 0 && grading.at_corners < spacing)
    points += 0.75 * double(grading.corners.size()) * about_tip(grading.at_corners, grading.growth, spacing);
  for (const auto& edge : grading.edges)
    points += edge_length({outline.outer, {}}, edge.name) * beside_layer(edge, grading.growth, spacing);
  return packing * points;
}

}  // namespace geometry
