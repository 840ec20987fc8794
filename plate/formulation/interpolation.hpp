#pragma once
#include <cstdint>
#include <utility>
#include <vector>
#include "geometry/shape/crack_path.hpp"

namespace geometry {
class CellLocator;
}

namespace plate {

/// A point's weight in an interpolated value.
struct Share {
  std::uint32_t point;
  double weight;
};

using PlacedPoint = std::pair<std::uint32_t, geometry::Point>;

/// Of the first `count` points those as near as `reach` from which no crack parts the place. Lengths in spacings.
std::vector<PlacedPoint> seen_from(const geometry::Point& at, double reach, const std::vector<geometry::Point>& points,
                                   std::size_t count, const std::vector<geometry::CrackPath>& cracks);

/// Linear moving least squares with weight 1/distance^2 over the points given: exact for linear fields where the
/// points span the plane, the point's own value where `at` is one of them, empty without points. Lengths in spacings.
std::vector<Share> interpolation(const std::vector<PlacedPoint>& points, const geometry::Point& at);

/// Linear in a triangle, bilinear in a square: in the cell about `at` [length], or nearest to it. A place on a crack
/// belongs to the cell on the side of +x, or of +y where the crack is horizontal.
std::vector<Share> interpolation(const geometry::CellLocator& cells, double spacing, const geometry::Point& at);

}  // namespace plate
