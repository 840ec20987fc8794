#include "geometry/cells/locator.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/predicates.hpp"

namespace geometry {

CellLocator::CellLocator(const Tessellation& cells) : cells_(cells) {
  const auto in_buckets = [&](std::uint32_t k) -> Point {
    return (cells.positions[k] - cells.units.origin) / cells.units.spacing;
  };
  Point low = in_buckets(0).cwiseMax(0), high = low;
  for (std::uint32_t k = 0; k < cells.positions.size(); ++k)
    low = low.cwiseMin(in_buckets(k).cwiseMax(0)), high = high.cwiseMax(in_buckets(k));
  low_ = {long(low.x()), long(low.y())}, high_ = {long(high.x()), long(high.y())};
  last_ = cells.window ? cells.window->last : high_;
  const auto for_buckets = [&](const auto& visit) {
    std::uint32_t cell = 0;
    const auto of = [&](const auto& corners) {
      Point from = in_buckets(corners[0]), to = from;
      for (const auto k : corners) from = from.cwiseMin(in_buckets(k)), to = to.cwiseMax(in_buckets(k));
      for (long row = std::max(low_[1], long(from.y())); row <= std::min(high_[1], long(to.y())); ++row)
        for (long column = std::max(low_[0], long(from.x())); column <= std::min(high_[0], long(to.x())); ++column)
          visit(std::size_t(bucket(column, row)), cell);
      ++cell;
    };
    for (const auto& square : cells.squares) of(square);
    for (const auto& triangle : cells.triangles) of(triangle);
  };
  first_.assign(std::size_t(width() * (high_[1] - low_[1] + 1)) + 1, 0);
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
  const long column = std::clamp(long(std::floor(u.x())), 0L, last_[0]);
  const long row = std::clamp(long(std::floor(u.y())), 0L, last_[1]);
  double least = -std::numeric_limits<double>::infinity();
  std::uint32_t best = 0;
  for (long reach = 0; std::isinf(least) && reach <= std::max(last_[0], last_[1]); ++reach)
    for (long r = std::max(low_[1], row - reach); r <= std::min(high_[1], row + reach); ++r)
      for (long c = std::max(low_[0], column - reach); c <= std::min(high_[0], column + reach); ++c)
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
