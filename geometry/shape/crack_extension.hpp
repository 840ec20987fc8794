#pragma once
#include <optional>
#include "geometry/shape/crack_path.hpp"

namespace geometry {

/// What a tip that runs straight on meets first.
struct Obstacle {
  double distance;  // [length]
  Point position;
  std::string name;                  // of the edge or hole; empty: a crack
  std::optional<std::size_t> crack;  // its number
};

/// The first edge, hole or crack on the segment of length `reach` from the tip along the unit vector `direction`, its
/// own crack among them.
std::optional<Obstacle> obstacle_ahead(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                       const Point& direction, double reach);

/// The point of edges, holes and other cracks that is nearest to the tip in the half plane ahead of it, within `reach`
/// [length]. What lies behind a tip, a crack that has met its own among it, is nothing that it can reach.
std::optional<Obstacle> nearest_obstacle(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                         double reach);

/// Moves the end of a crack on to a point: straight on the last vertex moves, else it becomes a bend.
void extend(Polyline& crack, bool at_back, const Point& to);

/// Length of a polyline.
double length(const Polyline& polyline);

}  // namespace geometry
