#pragma once
#include <limits>

#include "geometry/shape/outline.hpp"
#include "plate/edges/lattice_body.hpp"

namespace plate {

/// True where all edges are along the axes, those of holes too.
bool is_rectilinear(const geometry::Outline& outline);

/// A distance, and the place in the middle of it.
struct Distance {
  double value = std::numeric_limits<double>::infinity();
  geometry::Point at{0, 0};
};

/// The least distances of an outline with edges along the axes; corners count where they show each other their backs.
struct Clearance {
  Distance width;  // of the plate
  Distance gap;    // outside it: in holes and notches
  Distance step;   // between two corners along an edge
};
Clearance clearance(const geometry::Outline& outline);

/// The points of the lattice inside the outline [spacings; the node (0, 0) is at (1/2, 1/2)], edges along the axes at
/// any place between two rows of points.
/// @throws Refused  an edge through a row of points, or no point inside
LatticeBody rectilinear_body(const geometry::Outline& outline, int reach);

/// The least distances of an outline with edges in any direction, from the middles of parts of edges about a spacing
/// long straight across: `width` to an edge that is not the next one, `gap` to any; `step` of an edge beside a corner
/// that turns by more than 30 degrees.
Clearance oblique_clearance(const geometry::Outline& outline, double spacing);

/// The shortest straight edge.
Distance shortest_edge(const geometry::Outline& outline);

}  // namespace plate
