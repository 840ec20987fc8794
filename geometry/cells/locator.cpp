#include "geometry/cells/locator.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/predicates.hpp"

namespace geometry {

CellLocator::CellLocator(const Tessellation& cells) : cells_(cells) {
  Point high(0, 0);
  const auto in_buckets = [&](std::uint32_t k) -> Point {
    return (cells.positions[k] - cells.units.origin) / cells.units.spacing;
  };
  for (std::uint32_t k = 0; k < cells.positions.size(); ++k) high = high.cwiseMax(in_buckets(k));
  columns_ = long(high.x()) + 1, rows_ = long(high.y()) + 1;
  const auto for_buckets = [&](const auto& visit) {
    std::uint32_t cell = 0;
    const auto of = [&](const auto& corners) {
      Point low = in_buckets(corners[0]), top = low;
      for (const auto k : corners) low = low.cwiseMin(in_buckets(k)), top = top.cwiseMax(in_buckets(k));
      for (long row = std::max(0L, long(low.y())); row <= std::min(rows_ - 1, long(top.y())); ++row)
        for (long column = std::max(0L, long(low.x())); column <= std::min(columns_ - 1, long(top.x())); ++column)
          visit(std::size_t(bucket(column, row)), cell);
      ++cell;
    };
    for (const auto& square : cells.squares) of(square);
    for (const auto& triangle : cells.triangles) of(triangle);
  };
  first_.assign(std::size_t(columns_ * rows_) + 1, 0);
  for_buckets([&](std::size_t b, std::uint32_t) { ++first_[b + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  members_.resize(first_.back());
  auto next = first_;
  for_buckets([&](std::size_t b, std::uint32_t cell) { members_[next[b]++] = cell; });
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
  const long column = std::clamp(long(std::floor(u.x())), 0L, columns_ - 1);
  const long row = std::clamp(long(std::floor(u.y())), 0L, rows_ - 1);
  double least = -std::numeric_limits<double>::infinity();
  std::uint32_t best = 0;
  for (long reach = 0; std::isinf(least) && reach < std::max(columns_, rows_); ++reach)
    for (long r = std::max(0L, row - reach); r <= std::min(rows_ - 1, row + reach); ++r)
      for (long c = std::max(0L, column - reach); c <= std::min(columns_ - 1, column + reach); ++c)
        for (auto m = first_[std::size_t(bucket(c, r))]; m < first_[std::size_t(bucket(c, r)) + 1]; ++m) {
          // how far inside, by the nearest side; of a square, the weights would be products
          auto found = weighted(members_[m], seen);
          if (found.count == 4) {
            const double s = found.weights[1] + found.weights[2], t = found.weights[2] + found.weights[3];
            found.weights = {s, t, 1 - s, 1 - t};
          }
          const double inside = *std::min_element(found.weights.begin(), found.weights.begin() + long(found.count));
          if (inside > least) least = inside, best = members_[m];
        }
  return weighted(best, at);
}

}  // namespace geometry
