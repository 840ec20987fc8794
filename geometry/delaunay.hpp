#pragma once
#include <array>
#include "geometry/curves.hpp"

namespace geometry {

/// Triangles, counter-clockwise, of all points, with the pieces among their sides. Throws std::invalid_argument where
/// pieces cross.
std::vector<std::array<std::uint32_t, 3>> delaunay(const std::vector<Point>& points,
                                                   const std::vector<std::array<std::uint32_t, 2>>& pieces);

/// Points, pieces between them and triangles that fill an outline.
struct Triangles {
  std::vector<Point> points;
  std::vector<Curves::Piece> pieces;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
};

/// The plate within the curves filled with triangles of the size that is wanted (Delaunay refinement, then Lloyd's
/// optimisation). Pieces may be halved. Throws std::invalid_argument where pieces cross.
Triangles refined_delaunay(const Curves& curves, const Sizing& sizing);

}  // namespace geometry
