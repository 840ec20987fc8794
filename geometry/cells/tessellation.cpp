#include "geometry/cells/tessellation.hpp"

#include <algorithm>

#include "geometry/cells/rows/whole_lattice.hpp"
#include "geometry/cells/untied_cells.hpp"

namespace geometry {
namespace {

Sizing sizing_of(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing, const Grading& grading) {
  struct Source {
    Point centre;
    double radius, size;
  };
  std::vector<Source> sources;
  if (grading.at_tips)
    for (const auto& tip : tips(cracks)) sources.push_back({tip.position, 0, *grading.at_tips / spacing});
  std::vector<std::pair<Polyline, double>> rims;
  for (const auto& hole : outline.holes) {
    if (!grading.at_holes) break;
    if (const auto* circle = std::get_if<Circle>(&hole))
      sources.push_back({circle->centre, circle->radius, *grading.at_holes / spacing});
    else if (const auto* polygon = std::get_if<Polygon>(&hole)) {
      rims.emplace_back(polygon->vertices, *grading.at_holes / spacing);
      rims.back().first.push_back(polygon->vertices.front());
    }
  }
  return [sources, rims, growth = grading.growth](const Point& x) {
    double size = 1;
    for (const auto& source : sources)
      size = std::min(size, source.size + growth * std::max(0.0, (x - source.centre).norm() - source.radius));
    for (const auto& [rim, at_rim] : rims) size = std::min(size, at_rim + growth * distance(rim, x));
    return size;
  };
}

}  // namespace

Tessellation tessellation(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing,
                          const std::vector<Point>& singles, const Grading& grading) {
  if (!grading.at_tips && !grading.at_holes) return WholeLattice(outline, cracks, spacing, singles).cells();
  Tessellation result;
  result.units = {bounding_box(outline).first, spacing}, result.graded = true;
  const auto place = [&](const Point& x) -> Point { return result.units.to_units(x); };
  const Outline in_cells = placed(outline, place, 1 / spacing);
  auto paths = cracks;
  for (auto& path : paths) std::transform(path.vertices.begin(), path.vertices.end(), path.vertices.begin(), place);
  std::vector<Point> places;
  std::transform(singles.begin(), singles.end(), std::back_inserter(places), place);
  const Sizing sizing = sizing_of(in_cells, paths, spacing, grading);
  const Curves found = curves(in_cells, paths, places, sizing, false);
  std::vector<Point> at_tips;
  for (const auto& tip : tips(paths)) at_tips.push_back(tip.position);
  Cells cells = graded_cells(found, sizing, at_tips);
  const auto origin = part(cells);
  result.borders = borders(cells, origin);
  result.names = found.names;
  for (const auto& u : cells.positions) {
    result.local.push_back(spacing * u);
    result.positions.push_back(result.units.from_lattice(u));
  }
  result.squares = std::move(cells.squares), result.triangles = std::move(cells.triangles);
  return result;
}

}  // namespace geometry
