#pragma once
#include <optional>

#include "geometry/shape/outline.hpp"

namespace geometry {

using Polyline = std::vector<Point>;

/// Kind of a crack end: a tip inside the plate, a mouth on an edge or hole, a junction on another crack.
enum class End { tip, mouth, junction };

/// A crack as a polyline with the kind of its two ends.
struct CrackPath {
  Polyline vertices;
  End front;  // at vertices.front()
  End back;   // at vertices.back()
};

/// A crack tip: its position and the unit direction straight ahead of it.
struct Tip {
  Point position;
  Point direction;
  std::size_t crack;
  bool at_back;
};

/// Distance from a place to the nearest edge or hole [length].
double distance_to_boundary(const Outline& outline, const Point& x);

/// The polylines with their ends classified. An end within `tolerance` of the boundary is a mouth, one within
/// `tolerance` of another crack (or of another part of its own) a junction, any other a tip.
std::vector<CrackPath> crack_paths(const Outline& outline, const std::vector<Polyline>& polylines, double tolerance);

/// The tips of all cracks: front before back, in the order of the cracks.
std::vector<Tip> tips(const std::vector<CrackPath>& paths);

/// True where the crack separates two points, so that the bond between them is broken. Exact, by two rules: a bond that
/// merely touches a tip stays; a point exactly on the crack lies on the side of +x (+y where the crack is horizontal),
/// as if all points were moved by the infinitesimal (e, e^2). Mouths and junctions are closed ends: a bond through them
/// is broken.
bool separates(const CrackPath& crack, const Point& p, const Point& q);

/// Errors of the cracks: fewer than two vertices, zero length, self-crossing, outside the plate, through a hole, wholly
/// on an edge.
std::vector<GeometryError> errors(const Outline& outline, const std::vector<Polyline>& polylines, double tolerance);

/// Distance of a point from a polyline.
double distance(const Polyline& polyline, const Point& point);

/// First obstacle that a tip running straight on meets.
struct Obstacle {
  double distance;  // [length]
  Point position;
  std::string name;                  // of the edge or hole; empty: a crack
  std::optional<std::size_t> crack;  // its number
};

/// The first edge, hole or crack on the segment of length `reach` from the tip along the unit vector `direction`, its
/// own crack among them. Another crack that the segment misses by less than `beside` counts where the tip is that near
/// to it, or else where a vertex of it is; none of two that are equally far.
std::optional<Obstacle> obstacle_ahead(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                       const Point& direction, double reach, double beside = 0);

/// The point of edges, holes and other cracks that is nearest to the tip in the half plane ahead of it, within `reach`
/// [length]. What lies behind a tip, a crack that has met its own among it, is nothing that it can reach.
std::optional<Obstacle> nearest_obstacle(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                         double reach);

/// Moves the end of a crack on to a point: straight on the last vertex moves, else it becomes a bend.
void extend(Polyline& crack, bool at_back, const Point& to);

/// Length of a polyline.
double length(const Polyline& polyline);

}  // namespace geometry
