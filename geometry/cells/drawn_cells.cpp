#include "geometry/cells/drawn_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>

#include "geometry/cells/lattice_cells.hpp"
#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

constexpr auto none = std::numeric_limits<std::uint32_t>::max();
constexpr double on_curve = 1e-8;  // a point that is nearer to a curve counts as on it [spacings]
const Point half{0.5, 0.5};        // the centres of cells become the corners of those that are drawn

/// The circle as a polygon with corners at the mouths of cracks, and chords that are off by 1/500 spacing at most.
Polygon polygon_of(const Circle& circle, const std::vector<CrackPath>& cracks) {
  constexpr double off = 1.0 / 500, least = 32;
  const double longest = std::min(2 * std::numbers::pi * circle.radius / least, std::sqrt(8 * circle.radius * off));
  const auto angle = [&](const Point& x) { return std::atan2(x.y() - circle.centre.y(), x.x() - circle.centre.x()); };
  Polygon result;
  auto& ring = result.vertices;
  for (const auto& crack : cracks)
    for (const auto& x : {crack.vertices.front(), crack.vertices.back()})
      if (std::abs((x - circle.centre).norm() - circle.radius) < 1e-5) ring.push_back(x);
  if (ring.empty()) ring.push_back(circle.centre + Point(circle.radius, 0));
  std::ranges::sort(ring, {}, angle);
  std::vector<Point> all;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double from = angle(ring[i]),
                 to = i + 1 < ring.size() ? angle(ring[i + 1]) : angle(ring[0]) + 2 * std::numbers::pi;
    const int parts = std::max(1, int(std::ceil((to - from) * circle.radius / longest)));
    all.push_back(ring[i]);
    for (int n = 1; n < parts; ++n) {
      const double at = from + (to - from) * n / parts;
      all.push_back(circle.centre + circle.radius * Point(std::cos(at), std::sin(at)));
    }
  }
  ring = std::move(all);
  result.edge_names.assign(ring.size(), circle.name);
  return result;
}

/// Adds the points of the lattice that a segment runs through.
void add_crossed(const Point& a, const Point& b, std::vector<Point>& crossed) {
  const int axis = std::abs(b.x() - a.x()) >= std::abs(b.y() - a.y()) ? 0 : 1;
  const double length = b[axis] - a[axis];
  if (length == 0) return;
  const auto [low, high] = std::minmax(a[axis], b[axis]);
  for (double x = std::ceil(low - on_curve); x <= high + on_curve; ++x) {
    Point at;
    at[axis] = x;
    at[1 - axis] = std::round(a[1 - axis] + (b[1 - axis] - a[1 - axis]) * (x - a[axis]) / length);
    if (distance_to_segment(a, b, at) < on_curve) crossed.push_back(at);
  }
}

using Corners = std::span<const std::uint32_t>;  // of a cell

/// Cells that have a corner at each of the wanted points.
Grouped<Corners> cells_at(const std::vector<char>& wanted, const Cells& cells) {
  return {wanted.size(), [&](const auto& visit) {
            for_cells(cells, [&](const Corners& corners) {
              for (const auto k : corners)
                if (wanted[k]) visit(k, corners);
            });
          }};
}

class Drawing {
public:
  Drawing(const Cells& cells, const std::vector<Point>& lattice)
      : cells_(cells), lattice_(lattice), index_(lattice), point_(cells.positions.size(), none) {}

  DrawnCells operator()(const LatticeUnits& units) {
    find_points();
    DrawnCells result;
    const auto count = std::uint32_t(lattice_.size());
    std::vector<std::uint32_t> number(point_);
    std::vector<char> wanted(point_.size(), 0);
    for (std::uint32_t k = 0; k < point_.size(); ++k) {
      if (point_[k] != none) continue;
      number[k] = count + std::uint32_t(result.corners.size());
      result.corners.push_back({units.from_lattice(cells_.positions[k] - half), {}});
      wanted[k] = 1;
    }
    for (int ring = 0; ring < 2; ++ring)  // what is seen lies two cells away at most, save beside narrow places
      wanted = grown(cells_, wanted);
    const auto about = cells_at(wanted, cells_);
    for (std::uint32_t k = 0; k < point_.size(); ++k)
      if (point_[k] == none) result.corners[number[k] - count].seen = seen(k, about);
    result.squares = cells_.squares, result.triangles = cells_.triangles;
    for_corners(result, [&](std::uint32_t& k) { k = number[k]; });
    return result;
  }

private:
  /// Assigns corners of cells to points: of those at its place the one on its side of the crack.
  void find_points() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> several;
    std::vector<std::uint32_t> corner_of(lattice_.size(), none);
    for (std::uint32_t k = 0; k < point_.size(); ++k) {
      const Point& x = cells_.positions[k];
      const Point at(std::round(x.x()), std::round(x.y()));
      if ((x - at).cwiseAbs().maxCoeff() > on_curve) continue;
      const auto p = index_.at(at - half);
      if (!p) continue;
      if (corner_of[*p] == none)
        corner_of[*p] = k;
      else
        several[*p].push_back(k);
    }
    if (!several.empty()) {
      std::vector<char> wanted(point_.size(), 0);
      for (auto& [p, corners] : several) {
        corners.push_back(corner_of[p]);
        for (const auto k : corners) wanted[k] = 1;
      }
      const auto about = cells_at(wanted, cells_);
      for (const auto& [p, corners] : several)
        for (const auto k : corners)
          if (std::ranges::any_of(about[k], [&](const auto& cell) { return ahead(cell, k); })) corner_of[p] = k;
    }
    for (std::uint32_t p = 0; p < corner_of.size(); ++p)
      if (corner_of[p] != none) point_[corner_of[p]] = p;
  }

  /// True where the cell lies about x + (e, e^2), with x its corner k.
  bool ahead(const Corners& cell, std::uint32_t k) const {
    const auto c = std::size_t(std::ranges::find(cell, k) - cell.begin());
    const Point& x = cells_.positions[k];
    const Point next = cells_.positions[cell[(c + 1) % cell.size()]] - x;
    const Point before = cells_.positions[cell[(c + cell.size() - 1) % cell.size()]] - x;
    const auto left_of = [](const Point& d) { return d.y() != 0 ? -d.y() > 0 : d.x() > 0; };  // of d: (e, e^2)
    return left_of(next) && !left_of(before);
  }

  /// Points within two cells of a corner; where there is none, further along the cells; at last the nearest.
  std::vector<std::uint32_t> seen(std::uint32_t corner, const Grouped<Corners>& about) const {
    constexpr double reach = 2.5;
    constexpr int rings = 2, most_rings = 8;
    const Point& x = cells_.positions[corner];
    std::vector<std::uint32_t> known{corner}, found;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings || (ring < most_rings && found.empty()); ++ring)
      for (const auto end = known.size(); begin < end; ++begin)
        for (const auto& cell : about[known[begin]])
          for (const auto k : cell) {
            if (std::ranges::find(known, k) != known.end()) continue;
            known.push_back(k);
            if (point_[k] != none && (ring >= rings || (cells_.positions[k] - x).norm() < reach))
              found.push_back(point_[k]);
          }
    if (found.empty()) found.push_back(nearest(x - half));
    return found;
  }

  std::uint32_t nearest(const Point& u) const {
    const auto found =
        std::ranges::min_element(lattice_, {}, [&](const Point& other) { return (other - u).squaredNorm(); });
    return std::uint32_t(found - lattice_.begin());
  }

  const Cells& cells_;
  const std::vector<Point>& lattice_;
  CellIndex index_;
  std::vector<std::uint32_t> point_;  // per corner of cells, or none
};

}  // namespace

DrawnCells drawn_cells(const Outline& outline, const std::vector<CrackPath>& cracks, const LatticeUnits& units,
                       const std::vector<Point>& lattice) {
  const auto [low, high] = bounding_box(outline);
  const double size = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  const double noise = std::max(1e-9, 8 * std::numeric_limits<double>::epsilon() * size / units.spacing);
  const auto place = [&](const Point& x) -> Point { return onto_lattice(units.to_units(x) + half, noise); };
  Outline in_cells = placed(outline, place, 1 / units.spacing);
  auto paths = cracks;
  for (auto& path : paths) std::ranges::transform(path.vertices, path.vertices.begin(), place);
  for (auto& hole : in_cells.holes)
    if (const auto* circle = std::get_if<Circle>(&hole)) hole = polygon_of(Circle(*circle), paths);
  std::vector<Point> crossed;
  for (const auto& edge : straight_edges(in_cells)) add_crossed(edge.from, edge.to, crossed);
  for (const auto& path : paths)
    for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i)
      add_crossed(path.vertices[i], path.vertices[i + 1], crossed);
  const Sizing one = [](const Point&) { return 1.0; };
  auto cells = lattice_cells(curves(in_cells, paths, crossed, one, true), on_curve / 2).cells();
  part(cells);
  return Drawing(cells, lattice)(units);
}

}  // namespace geometry
