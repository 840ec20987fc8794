#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>
#include "geometry/shape/outline.hpp"

namespace geometry {

/// Which point lies in which cell of the lattice.
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

}  // namespace geometry
