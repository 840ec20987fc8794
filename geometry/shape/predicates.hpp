#pragma once
#include <sstream>
#include "geometry/shape/outline.hpp"

/// Predicates and small measures that the sources of this folder share; no header but this one names them.
namespace geometry {

using Ring = std::vector<Point>;

/// The vertex after vertex i, cyclic.
inline const Point& next(const Ring& ring, std::size_t i) {
  return ring[i + 1 == ring.size() ? 0 : i + 1];
}

inline double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// +1 where c lies to the left of the line from a to b, 0 on it, -1 to the right. Exact.
int side(const Point& a, const Point& b, const Point& c);

/// True where the bounding boxes of the segments pq and ab share a point.
bool boxes_meet(const Point& p, const Point& q, const Point& a, const Point& b);

/// +1 inside the ring, 0 on it, -1 outside, by the parity of the edges to the right of the point. Exact.
int position(const Ring& ring, const Point& x);

/// Positive where the ring runs counter-clockwise.
double signed_area(const Ring& ring);

/// Corners of the outer polygon and of polygonal holes at which the plate takes more than 200 degrees.
std::vector<Point> singular_corners(const Outline& outline);

/// The point of the segment ab nearest to x.
Point nearest_on_segment(const Point& a, const Point& b, const Point& x);

/// Distance of x from the segment ab; a segment without length counts as a point.
double distance_to_segment(const Point& a, const Point& b, const Point& x);

/// The parts written one after another.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

/// "(x, y)"
std::string at(const Point& x);

}  // namespace geometry
