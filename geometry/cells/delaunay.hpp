#pragma once
#include <array>
#include "geometry/cells/curves.hpp"

namespace geometry {

/// Triangles that know their neighbours.
struct Triangulated {
  static constexpr std::int32_t none = -1;
  std::vector<std::array<std::uint32_t, 3>> corners;  // counter-clockwise
  std::vector<std::array<std::int32_t, 3>> across;    // beyond the side opposite to each corner
};

/// All points triangulated, with the pieces among the sides. Throws std::invalid_argument where pieces cross.
Triangulated delaunay(const std::vector<Point>& points, const std::vector<std::array<std::uint32_t, 2>>& pieces);

/// A side that parts what belongs to the plate from what does not: which of both lies to its left and right.
struct Fence {
  std::uint32_t from, to;
  bool left, right;
};

/// The fences that the pieces of edges are: the plate lies to their left.
std::vector<Fence> fences(const std::vector<Curves::Piece>& pieces);

/// Which triangles belong to the plate: told by the fences, and by what hangs together between them. So coordinates
/// have no say in it. Throws std::logic_error where fences contradict each other.
std::vector<char> within(const Triangulated& triangles, const std::vector<Fence>& fences);

}  // namespace geometry
