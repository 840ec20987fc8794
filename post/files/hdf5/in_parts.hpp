#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace post {

/// Numbers of points as state.h5 takes them: of `count` points from `first` on, point by point, in the order of the
/// file. It asks from the first to the last, for points_at_once of them but at the end, and each part once; what it has
/// been given may be gone when it asks for the next.
using InParts = std::function<std::span<const double>(std::size_t first, std::size_t count)>;

/// Points that are written, and stored, together: 1.5 MB of a state.
constexpr std::size_t points_at_once = std::size_t(1) << 16;

/// Calls visit(first, count) for the parts of so many points.
template <typename Visit>
void for_each_part(std::size_t points, const Visit& visit) {
  for (std::size_t first = 0; first < points; first += points_at_once)
    visit(first, points - first < points_at_once ? points - first : points_at_once);
}

}  // namespace post
