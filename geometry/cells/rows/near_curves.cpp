#include "geometry/cells/rows/near_curves.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

/// Does the segment pass through the open square from `low` to low + (1, 1)?
bool enters_square(const Point& a, const Point& b, const Point& low) {
  double first = 0, last = 1;
  for (const int axis : {0, 1}) {
    const double d = b[axis] - a[axis], from = low[axis] - a[axis], to = from + 1;
    if (d == 0) {
      if (from >= 0 || to <= 0) return false;
      continue;
    }
    first = std::max(first, std::min(from / d, to / d));
    last = std::min(last, std::max(from / d, to / d));
  }
  return last - first > 1e-9;
}

/// Calls visit(i, j) for all in the box about a segment.
template <typename Visit>
void about(const Point& a, const Point& b, double margin, long last_i, long last_j, const Visit& visit) {
  const auto low = [margin](double x, double y) { return std::max(0L, long(std::ceil(std::min(x, y) - margin))); };
  const auto high = [margin](double x, double y) { return long(std::floor(std::max(x, y) + margin)); };
  for (long j = low(a.y(), b.y()); j <= std::min(high(a.y(), b.y()), last_j); ++j)
    for (long i = low(a.x(), b.x()); i <= std::min(high(a.x(), b.x()), last_i); ++i) visit(i, j);
}

std::pair<long, long> key(const NearCurves::Mark& mark) {
  return {mark.row, mark.column};
}

}  // namespace

NearCurves::NearCurves(const Curves& curves, double clearance, long columns, long rows) {
  const auto mark = [&](const Point& a, const Point& b, bool is_edge) {
    about(a, b, 1.5, columns, rows, [&](long i, long j) {
      const bool left_out = distance_to_segment(a, b, Point(double(i), double(j))) < clearance;
      if (left_out || is_edge) marks_.push_back({std::int32_t(j), std::int32_t(i), left_out});
    });
  };
  for (const auto& x : curves.nodes) mark(x, x, false);
  for (const auto& piece : curves.pieces) {
    const Point &a = curves.nodes[piece.from], &b = curves.nodes[piece.to];
    mark(a, b, piece.edge != Curves::crack);
    about(a, b, 1, columns - 1, rows - 1, [&](long i, long j) {
      if (enters_square(a, b, {double(i), double(j)})) blocked_.emplace_back(j, i);
    });
  }
  for (const auto& x : curves.nodes)
    if (x.x() != std::round(x.x()) || x.y() != std::round(x.y()))
      about(x, x, 1, columns - 1, rows - 1, [&](long i, long j) {
        if (x.x() >= double(i) && x.y() >= double(j)) blocked_.emplace_back(j, i);
      });
  std::ranges::sort(marks_, {}, [](const Mark& one) { return std::tuple(one.row, one.column, !one.left_out); });
  const auto again = std::ranges::unique(marks_, {}, key);  // of several the first, which leaves out where any does
  marks_.erase(again.begin(), again.end());
  std::ranges::sort(blocked_);
  const auto twice = std::ranges::unique(blocked_);
  blocked_.erase(twice.begin(), twice.end());
}

std::span<const NearCurves::Mark> NearCurves::row(long j) const {
  return std::ranges::equal_range(marks_, j, {}, &Mark::row);
}

bool NearCurves::near(long i, long j) const {
  return std::ranges::binary_search(marks_, std::pair(j, i), {}, key);
}

std::vector<long> NearCurves::blocked(long j) const {
  std::vector<long> result;
  for (const auto& [row, column] : std::ranges::equal_range(blocked_, j, {}, &std::pair<long, long>::first))
    result.push_back(column);
  return result;
}

}  // namespace geometry
