#pragma once
#include "geometry/cloud.hpp"
#include <cstdint>
#include <functional>

namespace geometry {

/// Directed bonds of every point, grouped by point: the bonds of point k are first[k] ... first[k + 1] - 1, by
/// ascending neighbour. Bonds of the same vector share one entry of `vectors` (28 on a square lattice with horizon
/// 3.015 spacings).
struct Families {
  std::vector<std::size_t> first;        // size: points + 1
  std::vector<std::uint32_t> neighbour;  // the other point of each bond
  std::vector<std::uint32_t> vector_id;  // which of `vectors`
  std::vector<Point> vectors;            // x_j - x_k [length]

  std::size_t points() const { return first.size() - 1; }
  std::size_t bonds() const { return neighbour.size(); }
};

/// A question about the points k < j of a cloud; asked from several threads at once.
using Pairwise = std::function<bool(std::uint32_t k, std::uint32_t j)>;

/// All pairs within the horizon that see each other.
Families families(const Cloud& cloud, double horizon, const Pairwise& sees);

/// The families without the bonds that are cut.
Families without(const Families& families, const Pairwise& cut);

}  // namespace geometry
