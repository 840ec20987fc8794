#include "geometry/cells/tessellation.hpp"

#include <algorithm>
#include <limits>

#include "geometry/cells/rows/whole_lattice.hpp"
#include "geometry/cells/untied_cells.hpp"

namespace geometry {
namespace {

/// A force whose field disturbs that of a tip next to it.
struct NearForce {
  Point place, from;  // `from`: the nearest tip
  double size;        // wanted distance of points there
};

/// All in units of the spacing.
std::vector<NearForce> forces_near_tips(const std::vector<Point>& forces, const std::vector<Tip>& tips, double at_tips,
                                        double growth) {
  std::vector<NearForce> result;
  for (const auto& place : forces) {
    if (tips.empty()) break;
    const auto away = [&](const Tip& tip) { return (place - tip.position).norm(); };
    const auto& tip = *std::ranges::min_element(tips, {}, away);
    const double size = std::max(at_tips, growth * growth * away(tip));
    if (away(tip) > at_tips && size < std::min(1.0, at_tips + growth * away(tip)))
      result.push_back({place, tip.position, size});
  }
  return result;
}

Sizing sizing_of(const Outline& outline, const std::vector<CrackPath>& cracks, const std::vector<NearForce>& forces,
                 double spacing, const Grading& grading) {
  struct Source {
    Point centre;
    double radius, size;
    bool filled = false;  // with the plate
  };
  std::vector<Source> sources;
  if (grading.at_tips)
    for (const auto& tip : tips(cracks)) sources.push_back({tip.position, 0, *grading.at_tips / spacing});
  for (const auto& force : forces) sources.push_back({force.place, 0, force.size});
  for (const auto& corner : grading.corners) sources.push_back({corner, 0, grading.at_corners / spacing});
  struct Rim {
    Polyline line;
    double size;
    double layer = std::numeric_limits<double>::infinity(), beyond = 0;
  };
  std::vector<Rim> rims;
  const auto add = [&](const Hole& hole, bool filled) {
    if (const auto* circle = std::get_if<Circle>(&hole))
      sources.push_back({circle->centre, circle->radius, *grading.at_holes / spacing, filled});
    else if (const auto* polygon = std::get_if<Polygon>(&hole)) {
      rims.push_back({.line = polygon->vertices, .size = *grading.at_holes / spacing});
      rims.back().line.push_back(polygon->vertices.front());
    }
  };
  if (grading.at_holes) {
    for (const auto& hole : outline.holes) add(hole, false);
    for (const auto& part : grading.parts) add(part, true);
  }
  for (const auto& graded : grading.edges)
    for (const auto& edge : straight_edges({outline.outer, {}}))
      if (edge.name == graded.name)
        rims.push_back({.line = {edge.from, edge.to},
                        .size = graded.spacing / spacing,
                        .layer = graded.layer / spacing,
                        .beyond = graded.beyond});
  return [sources, rims, growth = grading.growth](const Point& x) {
    double size = 1;
    for (const auto& source : sources) {
      const double off = (x - source.centre).norm() - source.radius;
      size = std::min(size, source.size + growth * (source.filled ? std::abs(off) : std::max(0.0, off)));
    }
    for (const auto& rim : rims) {
      const double off = distance(rim.line, x);
      size = std::min(size, rim.size + growth * std::min(off, rim.layer) + rim.beyond * std::max(0.0, off - rim.layer));
    }
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
  std::vector<Point> acting;
  std::transform(grading.forces.begin(), grading.forces.end(), std::back_inserter(acting), place);
  Grading in_units = grading;
  in_units.parts = placed({{}, grading.parts}, place, 1 / spacing).holes;
  std::ranges::transform(grading.corners, in_units.corners.begin(), place);
  const auto ends = tips(paths);
  std::vector<NearForce> forces;
  if (grading.at_tips) forces = forces_near_tips(acting, ends, *grading.at_tips / spacing, grading.growth);
  const Sizing sizing = sizing_of(in_cells, paths, forces, spacing, in_units);
  const Curves found = curves(in_cells, paths, places, sizing, false);
  RingCentres centres;
  for (const auto& tip : ends) centres.tips.push_back(tip.position);
  for (const auto& force : forces) centres.forces.emplace_back(force.place, (force.place - force.from).normalized());
  Cells cells = graded_cells(found, sizing, centres);
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
