#pragma once
#include "geometry/cells/tessellation.hpp"

namespace geometry {

/// Cells for drawing points that lie at the centres of a lattice: squares between four of them, and triangles that fill
/// the plate up to its edges, holes and cracks. Circles are polygons whose corners are on them.
struct DrawnCells {
  /// A corner on an edge, a hole or the face of a crack.
  struct Corner {
    Point position;                   // [length]
    std::vector<std::uint32_t> seen;  // points about it that nothing parts from it; the nearest where there is none
  };
  std::vector<Corner> corners;
  // of points, and after them of corners
  std::vector<Tessellation::Square> squares;
  std::vector<Tessellation::Triangle> triangles;
};

/// `lattice`: the points, in lattice units. Where a crack runs through a point, this is on the side of +x, or of +y
/// where the crack is horizontal. Throws std::invalid_argument or std::logic_error where edges and cracks are closer to
/// each other than numbers can tell apart.
DrawnCells drawn_cells(const Outline& outline, const std::vector<CrackPath>& cracks, const LatticeUnits& units,
                       const std::vector<Point>& lattice);

}  // namespace geometry
