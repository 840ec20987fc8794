#pragma once
#include <algorithm>

#include "geometry/lattice/cloud.hpp"

namespace geometry {

inline bool is_empty(const CellBox& box) {
  return box.side(0) <= 0 || box.side(1) <= 0;
}

/// The cells that are in both; empty where there are none.
inline CellBox common(const CellBox& a, const CellBox& b) {
  return {{std::max(a.low[0], b.low[0]), std::max(a.low[1], b.low[1])},
          {std::min(a.high[0], b.high[0]), std::min(a.high[1], b.high[1])}};
}

/// Of the cells of all places between two corners [length].
inline CellBox box_between(const LatticeUnits& units, const Point& low, const Point& high) {
  CellBox box{cell_of(units.to_lattice(low)), cell_of(units.to_lattice(high))};
  for (long& side : box.high) ++side;
  return box;
}

}  // namespace geometry
