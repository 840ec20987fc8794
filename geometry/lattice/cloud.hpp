#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include "geometry/shape/crack_path.hpp"

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
  /// The same not rounded.
  Point to_units(const Point& x) const { return (x - origin) / spacing; }
  Point from_lattice(const Point& u) const { return origin + spacing * u; }
};

Outline to_lattice(const Outline& outline, const LatticeUnits& units);
/// With every vertex and centre placed anew, and lengths times `scale`.
Outline placed(const Outline& outline, const std::function<Point(const Point&)>& place, double scale);
std::vector<CrackPath> to_lattice(const std::vector<CrackPath>& paths, const LatticeUnits& units);

/// Points that stand for the plate, and after them fictitious points outside it (none at first).
struct Cloud {
  LatticeUnits units;
  std::vector<Point> positions;      // [length], plate points first
  std::vector<double> areas;         // [length^2], the part of each point's cell that lies in the plate
  std::size_t plate_points = 0;      // the rest are fictitious
  std::optional<CellBox> part = {};  // what was seeded; absent: all

  /// Was the cell of this place seeded, if the plate has it?
  bool seeded(const Point& x) const { return !part || part->contains(cell_of(units.to_lattice(x))); }

  std::size_t size() const { return positions.size(); }
};

/// The point of the plate nearest to x.
std::size_t nearest_plate_point(const Cloud& cloud, const Point& x);

}  // namespace geometry
