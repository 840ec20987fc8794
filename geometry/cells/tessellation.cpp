#include "geometry/cells/tessellation.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "geometry/cells/untied_cells.hpp"

namespace geometry {
namespace {

using Side = std::uint64_t;

Side directed(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t(from) << 32 | to;
}

Side side(std::uint32_t a, std::uint32_t b) {
  return directed(std::min(a, b), std::max(a, b));
}

/// Calls visit(corners, count) for every cell; the corners may be changed.
template <typename Cells, typename Visit>
void for_cells(Cells& cells, const Visit& visit) {
  for (auto& square : cells.squares) visit(square.data(), std::size_t(4));
  for (auto& triangle : cells.triangles) visit(triangle.data(), std::size_t(3));
}

struct Corner {
  std::uint32_t* point;         // in its cell
  std::uint32_t before, after;  // the corners next to it
  std::size_t part = 0;
};

/// Cells about a point that share a side which is no crack belong together: numbers their parts.
std::size_t parts(std::vector<Corner>& corners, std::uint32_t k, const std::unordered_map<Side, std::int32_t>& cracks) {
  std::size_t count = 0;
  std::vector<char> known(corners.size(), 0);
  for (std::size_t first = 0; first < corners.size(); ++first) {
    if (known[first]) continue;
    std::vector<std::size_t> open{first};
    known[first] = 1;
    while (!open.empty()) {
      auto& corner = corners[open.back()];
      open.pop_back();
      corner.part = count;
      for (std::size_t other = 0; other < corners.size(); ++other)
        for (const auto neighbour : {corner.before, corner.after})
          if (!known[other] && (corners[other].before == neighbour || corners[other].after == neighbour) &&
              !cracks.contains(side(k, neighbour)))
            known[other] = 1, open.push_back(other);
    }
    ++count;
  }
  return count;
}

/// Gives every part of the cells about a point on a curve its own point, new points last; returns for every point the
/// one that it comes from.
std::vector<std::uint32_t> part_cells(Cells& cells) {
  std::unordered_map<Side, std::int32_t> cracks;
  std::map<std::uint32_t, std::vector<Corner>> on_curves;
  for (const auto& piece : cells.pieces) {
    if (piece.edge == Curves::crack) cracks[side(piece.from, piece.to)] = piece.edge;
    on_curves[piece.from], on_curves[piece.to];
  }
  std::vector<std::uint32_t> origin(cells.positions.size());
  std::iota(origin.begin(), origin.end(), 0);
  std::vector<char> curved(cells.positions.size(), 0);
  for (const auto& [k, corners] : on_curves) curved[k] = 1;
  for_cells(cells, [&](std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c)
      if (curved[corner[c]])
        on_curves[corner[c]].push_back({corner + c, corner[(c + count - 1) % count], corner[(c + 1) % count]});
  });
  for (auto& [k, corners] : on_curves) {
    const auto count = parts(corners, k, cracks);
    for (std::size_t part = 1; part < count; ++part) {
      for (auto& corner : corners)
        if (corner.part == part) *corner.point = std::uint32_t(cells.positions.size());
      cells.positions.push_back(cells.positions[k]);
      origin.push_back(k);
    }
  }
  return origin;
}

/// Sides of cells that no other cell shares. `origin`: the points that the pieces of the curves speak of.
std::vector<Tessellation::Border> borders(const Cells& cells, const std::vector<std::uint32_t>& origin) {
  std::unordered_map<Side, std::int32_t> edge_of;
  std::vector<char> curved(*std::max_element(origin.begin(), origin.end()) + 1, 0);
  for (const auto& piece : cells.pieces) {
    edge_of[side(piece.from, piece.to)] = piece.edge;
    curved.at(piece.from) = curved.at(piece.to) = 1;
  }
  std::unordered_map<Side, std::pair<std::uint32_t, std::uint32_t>> open;
  std::vector<Side> order;
  for_cells(cells, [&](const std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) {
      const auto from = corner[c], to = corner[(c + 1) % count];
      if (!curved[origin[from]] || !curved[origin[to]]) continue;
      if (open.erase(side(from, to)) == 0) open[side(from, to)] = {from, to}, order.push_back(side(from, to));
    }
  });
  std::vector<Tessellation::Border> result;
  for (const auto key : order)
    if (const auto found = open.find(key); found != open.end()) {
      const auto [from, to] = found->second;
      const auto edge = edge_of.find(side(origin[from], origin[to]));
      if (edge == edge_of.end()) throw std::logic_error("a cell has a side that is neither shared nor on a curve");
      result.push_back({from, to, edge->second});
      open.erase(found);
    }
  return result;
}

/// Leaves out points without cells.
void compact(Cells& cells, std::vector<std::uint32_t>& origin) {
  constexpr auto unused = std::uint32_t(-1);
  std::vector<std::uint32_t> index(cells.positions.size(), unused);
  for_cells(cells, [&](const std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) index[corner[c]] = 0;
  });
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < index.size(); ++k)
    if (index[k] != unused) {
      cells.positions[next] = cells.positions[k], origin[next] = origin[k];
      index[k] = next++;
    }
  cells.positions.resize(next), origin.resize(next);
  for_cells(cells, [&](std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) corner[c] = index[corner[c]];
  });
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
  Cells cells = graded ? graded_cells(found, sizing, at_tips) : lattice_cells(found);

  auto origin = part_cells(cells);
  compact(cells, origin);
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
