#pragma once
#include <span>
#include "geometry/cells/curves.hpp"

namespace geometry {

/// Lattice points and squares that curves come near to, by rows: as many as the curves are long.
class NearCurves {
public:
  struct Mark {
    std::int32_t row, column;
    bool left_out;  // so near a curve that it is none of its own
  };

  /// Columns and rows of squares.
  NearCurves(const Curves& curves, double clearance, long columns, long rows);

  /// Lattice points near an edge, or too near a curve to stay, by ascending columns.
  std::span<const Mark> row(long j) const;
  bool near(long i, long j) const;
  /// Squares that a curve runs through or a node lies in, by ascending columns.
  std::vector<long> blocked(long j) const;

private:
  std::vector<Mark> marks_;
  std::vector<std::pair<long, long>> blocked_;  // row, column
};

}  // namespace geometry
