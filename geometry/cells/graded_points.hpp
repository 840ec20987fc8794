#pragma once
#include "geometry/cells/triangulation.hpp"

namespace geometry {

/// Adds points in rings about the ends of cracks, as far apart as wanted, until they are as far apart as anywhere else:
/// so the triangles about a tip are nearly equal, and the same on both sides of the crack.
void add_rings(TriangleMesh& mesh, const Curves& curves, const Sizing& sizing, const std::vector<Point>& tips);

/// Adds rings of points about a place in the plate. `away`: a unit vector along which other centres do not disturb the
/// rings.
void add_rings(TriangleMesh& mesh, const Sizing& sizing, const Point& place, const Point& away);

/// Adds points in rows of equilateral triangles wherever one spacing is wanted.
void add_rows(TriangleMesh& mesh, const Sizing& sizing);

/// Adds points where triangles are larger than wanted or have angles below 20.7 degrees, as far as the angles between
/// curves allow that and features are not smaller than 1/64 of what is wanted.
void refine(TriangleMesh& mesh, const Sizing& sizing);

/// Moves points that are on no curve, and none of its nodes, to the middle of the triangles about them.
void smooth(TriangleMesh& mesh, const Curves& curves, const Sizing& sizing);

}  // namespace geometry
