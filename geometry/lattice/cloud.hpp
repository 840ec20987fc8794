#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"

namespace geometry {

/// A cell of the lattice: column and row, from 0 at the lower left corner of the outline's bounding box.
using Cell = std::array<long, 2>;

/// The cell of a place [spacings].
inline Cell cell_of(const Point& u) {
  return {static_cast<long>(std::floor(u.x())), static_cast<long>(std::floor(u.y()))};
}

/// The cells from `low` to below `high`.
struct CellBox {
  Cell low{0, 0}, high{0, 0};

  bool contains(const Cell& cell) const {
    return cell[0] >= low[0] && cell[0] < high[0] && cell[1] >= low[1] && cell[1] < high[1];
  }
  long side(std::size_t axis) const { return high[axis] - low[axis]; }
  CellBox grown(long by) const { return {{low[0] - by, low[1] - by}, {high[0] + by, high[1] + by}}; }
};

/// Lattice units: the origin is the lower left corner of a cell, the spacing is 1. Coordinates are rounded to 2^-20
/// of a spacing, so that decimal noise in a case file decides nothing and predicates see exact numbers.
struct LatticeUnits {
  Point origin{0, 0};
  double spacing = 1;

  Point to_lattice(const Point& x) const;
  /// Converts a point to lattice units without rounding.
  Point to_units(const Point& x) const { return (x - origin) / spacing; }
  Point from_lattice(const Point& u) const { return origin + spacing * u; }
};

Outline to_lattice(const Outline& outline, const LatticeUnits& units);
/// Returns the outline with every vertex and centre mapped by `place`, and lengths times `scale`.
Outline placed(const Outline& outline, const std::function<Point(const Point&)>& place, double scale);
std::vector<CrackPath> to_lattice(const std::vector<CrackPath>& paths, const LatticeUnits& units);

/// Points that stand for the plate, and after them fictitious points outside it (none at first).
struct Cloud {
  LatticeUnits units;
  std::vector<Point> positions;      // [length], plate points first
  std::vector<double> areas;         // [length^2] in the plate, with that of cells beside that have no point
  std::size_t plate_points = 0;      // the rest are fictitious
  std::optional<CellBox> part = {};  // what was discretised; absent: all

  /// True where the cell of this place was discretised, if the plate has it.
  bool seeded(const Point& x) const { return !part || part->contains(cell_of(units.to_lattice(x))); }

  std::size_t size() const { return positions.size(); }
};

/// The point of the plate nearest to x.
std::size_t nearest_plate_point(const Cloud& cloud, const Point& x);

inline bool is_empty(const CellBox& box) {
  return box.side(0) <= 0 || box.side(1) <= 0;
}

/// The cells that are in both; empty where there are none.
inline CellBox common(const CellBox& a, const CellBox& b) {
  return {{std::max(a.low[0], b.low[0]), std::max(a.low[1], b.low[1])},
          {std::min(a.high[0], b.high[0]), std::min(a.high[1], b.high[1])}};
}

/// Box of the cells of all places between two corners [length].
inline CellBox box_between(const LatticeUnits& units, const Point& low, const Point& high) {
  CellBox box{cell_of(units.to_lattice(low)), cell_of(units.to_lattice(high))};
  for (long& side : box.high) ++side;
  return box;
}

/// Index from cells of the lattice to the points in them.
class CellIndex {
public:
  /// `lattice`: points in lattice units, at most one in each cell.
  explicit CellIndex(const std::vector<Point>& lattice) {
    Point low = Point::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const auto& u : lattice) low = low.cwiseMin(u), high = high.cwiseMax(u);
    low_ = low.array().floor();
    columns_ = static_cast<long>(std::floor(high.x()) - low_.x()) + 1;
    rows_ = static_cast<long>(std::floor(high.y()) - low_.y()) + 1;
    points_.assign(static_cast<std::size_t>(columns_ * rows_), none);
    for (std::uint32_t k = 0; k < lattice.size(); ++k) points_[*slot(lattice[k])] = k;
  }

  std::optional<std::uint32_t> at(const Point& u) const {
    const auto s = slot(u);
    if (!s || points_[*s] == none) return std::nullopt;
    return points_[*s];
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::optional<std::size_t> slot(const Point& u) const {
    const long c = static_cast<long>(std::floor(u.x() - low_.x())), r = static_cast<long>(std::floor(u.y() - low_.y()));
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) return std::nullopt;
    return static_cast<std::size_t>(r * columns_ + c);
  }

  Point low_;
  long columns_, rows_;
  std::vector<std::uint32_t> points_;
};

/// The square lattice of cell centres inside the outline, row by row from the lower left, with the area of each cell
/// and of those beside it without a point that lies in the plate. The lower left corner of its box is that of a cell.
/// `part`: of these cells only, in the same order; there may be none.
/// Throws std::invalid_argument where no cell centre lies inside the outline.
Cloud lattice(const Outline& outline, double spacing, const std::optional<CellBox>& part = {});

}  // namespace geometry
