#include "geometry/cells/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/cells/global_lattice.hpp"
#include "geometry/cells/uncracked_cells.hpp"
#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

/// A force whose field disturbs that of a tip next to it.
struct NearForce {
  Point place, from;  // `from`: the nearest tip
  double size;        // wanted distance of points there
};

/// Forces close enough to a tip to need finer points; all in units of the spacing.
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
  if (!grading.at_tips && !grading.at_holes) return GlobalLattice(outline, cracks, spacing, singles).cells();
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

namespace {

/// The other corners of the cells about every point.
Grouped<std::uint32_t> members_of(const Tessellation& cells) {
  return {cells.local.size(), [&](const auto& visit) {
            for_cells(cells, [&](const auto& corners) {
              for (std::size_t c = 0; c < corners.size(); ++c)
                for (std::size_t other = 1; other < corners.size(); ++other)
                  visit(corners[c], corners[(c + other) % corners.size()]);
            });
          }};
}

/// Ascending, each once.
void list(std::span<const std::uint32_t> members, std::vector<std::uint32_t>& found) {
  found.assign(members.begin(), members.end());
  keep_once(found);
}

}  // namespace

Families cell_families(const Tessellation& cells) {
  if (cells.squares.empty()) return exact_cell_families(cells);
  const auto members = members_of(cells);
  return families(cells.units.spacing, cells.local,
                  [&](std::uint32_t k, std::vector<std::uint32_t>& found) { list(members[k], found); });
}

Families exact_cell_families(const Tessellation& cells) {
  const auto members = members_of(cells);
  std::vector<Point> vectors;
  std::vector<std::uint32_t> pattern, found;
  std::vector<std::size_t> first{0};
  std::vector<Families::Step> steps;
  for (std::uint32_t k = 0; k < cells.local.size(); ++k) {
    list(members[k], found);
    for (const auto j : found) {
      steps.push_back({std::int32_t(j - k), std::uint32_t(vectors.size())});
      vectors.push_back(cells.local[j] - cells.local[k]);
    }
    pattern.push_back(k);
    first.push_back(steps.size());
  }
  return {std::move(vectors), std::move(pattern), std::move(first), std::move(steps)};
}

std::vector<Point> positions_inside_faces(const Tessellation& cells) {
  constexpr double step = 2e-6;
  std::vector<Point> inwards(cells.local.size(), Point(0, 0)), result = cells.positions;
  std::vector<double> near(result.size(), std::numeric_limits<double>::infinity());
  for (const auto& border : cells.borders) {
    if (border.edge != Curves::crack) continue;
    const Point along = cells.local[border.to] - cells.local[border.from];
    for (const auto k : {border.from, border.to}) {
      inwards[k] += Point(-along.y(), along.x()).normalized();
      near[k] = std::min(near[k], along.norm());
    }
  }
  for (std::size_t k = 0; k < result.size(); ++k)
    if (inwards[k].norm() > 1e-6) result[k] += step * near[k] * inwards[k].normalized();
  return result;
}

CellLocator::CellLocator(const Tessellation& cells) : cells_(cells) {
  const auto in_buckets = [&](std::uint32_t k) -> Point {
    return (cells.positions[k] - cells.units.origin) / cells.units.spacing;
  };
  Point low = in_buckets(0).cwiseMax(0), high = low;
  for (std::uint32_t k = 0; k < cells.positions.size(); ++k)
    low = low.cwiseMin(in_buckets(k).cwiseMax(0)), high = high.cwiseMax(in_buckets(k));
  low_ = {long(low.x()), long(low.y())}, high_ = {long(high.x()), long(high.y())};
  last_ = cells.window ? cells.window->last : high_;
  const auto for_buckets = [&](const auto& visit) {
    std::uint32_t cell = 0;
    for_cells(cells, [&](const auto& corners) {
      Point from = in_buckets(corners[0]), to = from;
      for (const auto k : corners) from = from.cwiseMin(in_buckets(k)), to = to.cwiseMax(in_buckets(k));
      for (long row = std::max(low_[1], long(from.y())); row <= std::min(high_[1], long(to.y())); ++row)
        for (long column = std::max(low_[0], long(from.x())); column <= std::min(high_[0], long(to.x())); ++column)
          visit(std::size_t(bucket(column, row)), cell);
      ++cell;
    });
  };
  members_ = {std::size_t(width() * (high_[1] - low_[1] + 1)), for_buckets};
}

CellLocator::Found CellLocator::weighted(std::uint32_t cell, const Point& at) const {
  if (cell < cells_.squares.size()) {
    const auto& square = cells_.squares[cell];
    const Point x = (at - cells_.positions[square[0]]) / cells_.units.spacing;
    const double s = x.x(), t = x.y();
    return {4, square, {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}};
  }
  const auto& [a, b, c] = cells_.triangles[cell - cells_.squares.size()];
  const Point &x = cells_.positions[a], p = cells_.positions[b] - x, q = cells_.positions[c] - x;
  const double area = cross(p, q), second = cross(at - x, q) / area, third = cross(p, at - x) / area;
  return {3, {a, b, c, 0}, {1 - second - third, second, third, 0}};
}

CellLocator::Found CellLocator::operator()(const Point& seen, const Point& at) const {
  const Point u = (seen - cells_.units.origin) / cells_.units.spacing;
  const long column = std::clamp(long(std::floor(u.x())), 0L, last_[0]);
  const long row = std::clamp(long(std::floor(u.y())), 0L, last_[1]);
  double least = -std::numeric_limits<double>::infinity();
  std::uint32_t best = 0;
  for (long reach = 0; std::isinf(least) && reach <= std::max(last_[0], last_[1]); ++reach)
    for (long r = std::max(low_[1], row - reach); r <= std::min(high_[1], row + reach); ++r)
      for (long c = std::max(low_[0], column - reach); c <= std::min(high_[0], column + reach); ++c)
        for (const auto cell : members_[std::size_t(bucket(c, r))]) {
          // how far inside, by the nearest side; of a square, the weights would be products
          auto found = weighted(cell, seen);
          if (found.count == 4) {
            const double s = found.weights[1] + found.weights[2], t = found.weights[2] + found.weights[3];
            found.weights = {s, t, 1 - s, 1 - t};
          }
          const double inside = *std::min_element(found.weights.begin(), found.weights.begin() + long(found.count));
          if (inside > least) least = inside, best = cell;
        }
  return weighted(best, at);
}

namespace {

constexpr double pi = std::numbers::pi;
const double packing = 2 / std::sqrt(3.0);  // of equilateral triangles

double perimeter(const Hole& hole) {
  if (const auto* circle = std::get_if<Circle>(&hole)) return 2 * pi * circle->radius;
  auto ring = std::get<Polygon>(hole).vertices;
  ring.push_back(ring.front());
  return length(ring);
}

/// Integral of 2 pi r / s^2 - 2 pi r / spacing^2 with s = least + growth r, until s is the spacing.
double about_tip(double least, double growth, double spacing) {
  const double r = (spacing - least) / growth;
  return 2 * pi / (growth * growth) * (std::log(spacing / least) + least / spacing - 1) -
         pi * r * r / spacing / spacing;
}

/// Integral of 1 / s^2 - 1 / spacing^2 away from an edge, per length of it, with s as in about_tip().
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
