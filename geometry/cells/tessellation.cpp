#include "geometry/cells/tessellation.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include "geometry/cells/untied_cells.hpp"

namespace geometry {
namespace {

/// Sides of cells that no other cell shares. `origin`: the points that the pieces of the curves speak of.
std::vector<Tessellation::Border> borders(const Cells& cells, const std::vector<std::uint32_t>& origin) {
  std::unordered_map<std::uint64_t, std::int32_t> edge_of;
  std::vector<char> curved(*std::max_element(origin.begin(), origin.end()) + 1, 0);
  for (const auto& piece : cells.pieces) {
    edge_of[side_between(piece.from, piece.to)] = piece.edge;
    curved.at(piece.from) = curved.at(piece.to) = 1;
  }
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> open;
  std::vector<std::uint64_t> order;
  for_cells(cells, [&](const std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) {
      const auto from = corner[c], to = corner[(c + 1) % count];
      if (!curved[origin[from]] || !curved[origin[to]]) continue;
      if (open.erase(side_between(from, to)) == 0)
        open[side_between(from, to)] = {from, to}, order.push_back(side_between(from, to));
    }
  });
  std::vector<Tessellation::Border> result;
  for (const auto key : order)
    if (const auto found = open.find(key); found != open.end()) {
      const auto [from, to] = found->second;
      const auto edge = edge_of.find(side_between(origin[from], origin[to]));
      if (edge == edge_of.end()) throw std::logic_error("a cell has a side that is neither shared nor on a curve");
      result.push_back({from, to, edge->second});
      open.erase(found);
    }
  return result;
}

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
  Tessellation result;
  const auto [low, high] = bounding_box(outline);
  result.units = {low, spacing};
  const bool graded = result.graded = grading.at_tips || grading.at_holes;
  const double noise = 8 * std::numeric_limits<double>::epsilon() * low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  const auto place = [&](const Point& x) -> Point {
    const Point u = result.units.to_units(x);
    return graded ? u : onto_lattice(u, std::max(1e-9, noise / spacing));
  };
  const Outline in_cells = placed(outline, place, 1 / spacing);
  auto paths = cracks;
  for (auto& path : paths) std::transform(path.vertices.begin(), path.vertices.end(), path.vertices.begin(), place);
  std::vector<Point> places;
  std::transform(singles.begin(), singles.end(), std::back_inserter(places), place);
  const Sizing sizing = sizing_of(in_cells, paths, spacing, grading);
  const Curves found = curves(in_cells, paths, places, sizing, !graded);
  std::vector<Point> at_tips;
  for (const auto& tip : tips(paths)) at_tips.push_back(tip.position);
  Cells cells = graded ? graded_cells(found, sizing, at_tips) : lattice_cells(found, 0.6);

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
