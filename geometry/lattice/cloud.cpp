#include "geometry/lattice/cloud.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <sstream>
#include <stdexcept>

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
  const auto points = std::span(cloud.positions).first(cloud.plate_points);
  const auto distance = [&](const Point& point) { return (point - x).squaredNorm(); };
  return static_cast<std::size_t>(std::ranges::min_element(points, {}, distance) - points.begin());
}

namespace {

constexpr double margin = 1.0 / 1024;  // cells; marks may be too many but never too few

/// The cells of the bounding box that are in `part`, in lattice units, with a mark on every cell that the boundary may
/// meet.
class Grid {
public:
  Grid(const Outline& outline, const std::optional<CellBox>& part) {
    const Point size = bounding_box(outline).second;
    box_.high = {static_cast<long>(std::ceil(size.x())), static_cast<long>(std::ceil(size.y()))};
    for (std::size_t axis = 0; part && axis < 2; ++axis) {
      box_.low[axis] = std::max(box_.low[axis], part->low[axis]);
      box_.high[axis] = std::max(box_.low[axis], std::min(box_.high[axis], part->high[axis]));
    }
    marks_.assign(static_cast<std::size_t>(box_.side(0)) * static_cast<std::size_t>(box_.side(1)), 0);
    for (const Edge& edge : straight_edges(outline)) mark(edge.from, edge.to);
    for (const Circle& circle : circles(outline)) mark(circle);
  }

  const CellBox& box() const { return box_; }
  bool marked(long column, long row) const { return marks_[index(column, row)] != 0; }

private:
  std::size_t index(long column, long row) const {
    return static_cast<std::size_t>((row - box_.low[1]) * box_.side(0) + column - box_.low[0]);
  }
  long first(double u, std::size_t axis) const {
    return std::max(box_.low[axis], static_cast<long>(std::floor(u - margin)));
  }
  long last(double u, std::size_t axis) const {
    return std::min(box_.high[axis] - 1, static_cast<long>(std::floor(u + margin)));
  }

  /// Row by row, the columns that the edge runs through.
  void mark(Point a, Point b) {
    if (a.y() > b.y()) std::swap(a, b);
    for (long row = first(a.y(), 1); row <= last(b.y(), 1); ++row) {
      const double height = b.y() - a.y();
      const auto x_at = [&](double y) {
        return height > 0 ? a.x() + (b.x() - a.x()) * std::clamp((y - a.y()) / height, 0.0, 1.0) : a.x();
      };
      const double low = x_at(static_cast<double>(row) - margin);
      const double high = height > 0 ? x_at(static_cast<double>(row + 1) + margin) : b.x();
      const long end = last(std::max(low, high), 0);
      for (long column = first(std::min(low, high), 0); column <= end; ++column) marks_[index(column, row)] = 1;
    }
  }

  /// Every cell whose centre is within half a diagonal of the circle.
  void mark(const Circle& circle) {
    const double reach = circle.radius + 1;
    for (long row = first(circle.centre.y() - reach, 1); row <= last(circle.centre.y() + reach, 1); ++row)
      for (long column = first(circle.centre.x() - reach, 0); column <= last(circle.centre.x() + reach, 0); ++column) {
        const Point centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        if (std::abs((centre - circle.centre).norm() - circle.radius) < std::sqrt(0.5) + margin)
          marks_[index(column, row)] = 1;
      }
  }

  CellBox box_;
  std::vector<char> marks_;
};

Point centre_of(long column, long row) {
  return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

/// The cells beside (column, row) that have a point and the largest area, along the axes or else across a corner.
std::vector<Cell> largest_beside(const Outline& outline, long column, long row) {
  constexpr double alike = 1e-9;
  for (const auto& ways : {std::array<Cell, 4>{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}},
                           std::array<Cell, 4>{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}}}) {
    std::vector<Cell> result;
    double most = 0;
    for (const auto& [x, y] : ways) {
      const Point centre = centre_of(column + x, row + y);
      const double area = contains(outline, centre) ? clipped_cell_area(outline, centre, 1) : 0;
      if (area > most + alike) result.clear(), most = area;
      if (area > 0 && area >= most - alike) result.push_back({column + x, row + y});
    }
    if (!result.empty()) return result;
  }
  return {};
}

/// Adds the areas in the plate of cells that have no point, as their centres lie outside, to the cells beside them.
/// Without them plates with oblique edges had 1.2 to 1.9 % less mass and load at 40 spacings a side.
void add_remnants(const Outline& outline, const Grid& grid, Cloud& cloud) {
  const double unit = cloud.units.spacing * cloud.units.spacing;
  std::map<Cell, double> more;
  const auto [low, high] = grid.box();
  for (long row = low[1]; row < high[1]; ++row)
    for (long column = low[0]; column < high[0]; ++column) {
      const Point centre = centre_of(column, row);
      if (!grid.marked(column, row) || contains(outline, centre)) continue;
      const double area = clipped_cell_area(outline, centre, 1);
      if (area <= 0) continue;
      const auto beside = largest_beside(outline, column, row);
      for (const auto& cell : beside) more[cell] += unit * area / double(beside.size());
    }
  const auto row_first = [](const Cell& cell) { return std::pair(cell[1], cell[0]); };
  const auto of_point = [&](const Point& x) { return row_first(cell_of(cloud.units.to_lattice(x))); };
  for (const auto& [cell, area] : more) {
    const auto at = std::ranges::lower_bound(cloud.positions, row_first(cell), {}, of_point);
    if (at != cloud.positions.end() && of_point(*at) == row_first(cell))
      cloud.areas[std::size_t(at - cloud.positions.begin())] += area;
  }
}

/// Adds the cells of one row. Neighbouring cells without a mark lie on the same side of the boundary.
void add_row(const Outline& outline, const Grid& grid, const CellBox& part, long row, Cloud& cloud) {
  const double unit = cloud.units.spacing * cloud.units.spacing;
  bool inside = false;
  const auto& [low, high] = part;
  for (long column = low[0]; column < high[0]; ++column) {
    const Point centre = centre_of(column, row);
    const bool marked = grid.marked(column, row);
    if (marked || column == low[0] || grid.marked(column - 1, row)) inside = contains(outline, centre);
    if (!inside) continue;
    cloud.positions.push_back(cloud.units.from_lattice(centre));
    cloud.areas.push_back(marked ? unit * clipped_cell_area(outline, centre, 1) : unit);
  }
}

}  // namespace

Cloud lattice(const Outline& outline, double spacing, const std::optional<CellBox>& part) {
  if (!(spacing > 0)) throw std::invalid_argument("the spacing of a lattice must be positive");
  Cloud cloud;
  cloud.units = {bounding_box(outline).first, spacing};
  const Outline in_cells = to_lattice(outline, cloud.units);
  const Grid grid(in_cells, part ? std::optional(part->grown(1)) : std::nullopt);
  const auto box = part ? common(*part, grid.box()) : grid.box();
  for (long row = box.low[1]; row < box.high[1]; ++row) add_row(in_cells, grid, box, row, cloud);
  add_remnants(in_cells, grid, cloud);
  cloud.plate_points = cloud.positions.size();
  cloud.part = part;
  if (cloud.plate_points > 0 || part) return cloud;
  std::ostringstream message;
  message << "a lattice of spacing " << spacing << " has no cell centre inside the plate";
  throw std::invalid_argument(message.str());
}

}  // namespace geometry
