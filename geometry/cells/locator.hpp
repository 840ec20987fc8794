#pragma once
#include "geometry/cells/tessellation.hpp"

namespace geometry {

/// Which cell is about a place.
class CellLocator {
public:
  /// The corners of a cell with the weights of linear (triangle) or bilinear (square) interpolation.
  struct Found {
    std::size_t count = 0;
    std::array<std::uint32_t, 4> points{};
    std::array<double, 4> weights{};
  };

  /// `cells` must outlive this.
  explicit CellLocator(const Tessellation& cells);

  /// The cell about `seen`, or nearest to it, with the weights for `at` [length].
  Found operator()(const Point& seen, const Point& at) const;

private:
  Found weighted(std::uint32_t cell, const Point& at) const;
  long width() const { return high_[0] - low_[0] + 1; }
  long bucket(long column, long row) const { return (row - low_[1]) * width() + column - low_[0]; }

  const Tessellation& cells_;
  Cell low_, high_;                     // the first and last columns and rows of buckets
  Cell last_;                           // of the whole plate
  std::vector<std::size_t> first_;      // per bucket, one spacing wide
  std::vector<std::uint32_t> members_;  // squares, then triangles
};

}  // namespace geometry
