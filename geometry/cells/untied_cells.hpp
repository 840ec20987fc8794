#pragma once
#include "geometry/cells/tessellation.hpp"

namespace geometry {

/// Cells before cracks part them: points at different places, and the pieces of edges and cracks among the sides of
/// cells. In lattice units.
struct Cells {
  std::vector<Point> positions;
  std::vector<Tessellation::Square> squares;
  std::vector<Tessellation::Triangle> triangles;
  std::vector<Curves::Piece> pieces;
};

/// Squares of the lattice where nothing disturbs it, triangles elsewhere.
Cells lattice_cells(const Curves& curves);

/// Triangles all over, of the size that is wanted, in rings about the tips.
Cells graded_cells(const Curves& curves, const Sizing& sizing, const std::vector<Point>& tips);

}  // namespace geometry
