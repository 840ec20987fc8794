#include "geometry/lattice/seeding.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace geometry {
namespace {

constexpr double margin = 1.0 / 1024;  // cells; marks may be too many but never too few

/// The cells of the bounding box, in lattice units, with a mark on every cell that the boundary may meet.
class Grid {
public:
  explicit Grid(const Outline& outline) {
    const Point size = bounding_box(outline).second;
    columns_ = static_cast<long>(std::ceil(size.x()));
    rows_ = static_cast<long>(std::ceil(size.y()));
    marks_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (const Edge& edge : straight_edges(outline)) mark(edge.from, edge.to);
    for (const Hole& hole : outline.holes)
      if (const auto* circle = std::get_if<Circle>(&hole)) mark(*circle);
  }

  long columns() const { return columns_; }
  long rows() const { return rows_; }
  bool marked(long column, long row) const { return marks_[index(column, row)] != 0; }

private:
  std::size_t index(long column, long row) const { return static_cast<std::size_t>(row * columns_ + column); }
  long first(double u) const { return std::max(0L, static_cast<long>(std::floor(u - margin))); }
  long last(double u, long count) const { return std::min(count - 1, static_cast<long>(std::floor(u + margin))); }

  /// Row by row, the columns that the edge runs through.
  void mark(Point a, Point b) {
    if (a.y() > b.y()) std::swap(a, b);
    for (long row = first(a.y()); row <= last(b.y(), rows_); ++row) {
      const double height = b.y() - a.y();
      const auto x_at = [&](double y) {
        return height > 0 ? a.x() + (b.x() - a.x()) * std::clamp((y - a.y()) / height, 0.0, 1.0) : a.x();
      };
      const double low = x_at(static_cast<double>(row) - margin);
      const double high = height > 0 ? x_at(static_cast<double>(row + 1) + margin) : b.x();
      const long end = last(std::max(low, high), columns_);
      for (long column = first(std::min(low, high)); column <= end; ++column) marks_[index(column, row)] = 1;
    }
  }

  /// Every cell whose centre is within half a diagonal of the circle.
  void mark(const Circle& circle) {
    const double reach = circle.radius + 1;
    for (long row = first(circle.centre.y() - reach); row <= last(circle.centre.y() + reach, rows_); ++row)
      for (long column = first(circle.centre.x() - reach); column <= last(circle.centre.x() + reach, columns_);
           ++column) {
        const Point centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        if (std::abs((centre - circle.centre).norm() - circle.radius) < std::sqrt(0.5) + margin)
          marks_[index(column, row)] = 1;
      }
  }

  long columns_ = 0, rows_ = 0;
  std::vector<char> marks_;
};

/// Adds the cells of one row. Neighbouring cells without a mark lie on the same side of the boundary.
void add_row(const Outline& outline, const Grid& grid, long row, Cloud& cloud) {
  const double unit = cloud.units.spacing * cloud.units.spacing;
  bool inside = false;
  for (long column = 0; column < grid.columns(); ++column) {
    const Point centre(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    const bool marked = grid.marked(column, row);
    if (marked || column == 0 || grid.marked(column - 1, row)) inside = contains(outline, centre);
    if (!inside) continue;
    cloud.positions.push_back(cloud.units.from_lattice(centre));
    cloud.areas.push_back(marked ? unit * clipped_cell_area(outline, centre, 1) : unit);
  }
}

}  // namespace

Cloud lattice(const Outline& outline, double spacing) {
  if (!(spacing > 0)) throw std::invalid_argument("the spacing of a lattice must be positive");
  Cloud cloud;
  cloud.units = {bounding_box(outline).first, spacing};
  const Outline in_cells = to_lattice(outline, cloud.units);
  const Grid grid(in_cells);
  for (long row = 0; row < grid.rows(); ++row) add_row(in_cells, grid, row, cloud);
  cloud.plate_points = cloud.positions.size();
  if (cloud.plate_points > 0) return cloud;
  std::ostringstream message;
  message << "a lattice of spacing " << spacing << " has no cell centre inside the plate";
  throw std::invalid_argument(message.str());
}

}  // namespace geometry
