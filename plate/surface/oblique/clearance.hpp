#pragma once
#include "plate/surface/rectilinear.hpp"

namespace plate {

/// The least distances of an outline with edges in any direction, from the middles of parts of edges about a spacing
/// long straight across: `width` to an edge that is not the next one, `gap` to any; `step` of an edge beside a corner
/// that turns by more than 30 degrees.
Clearance oblique_clearance(const geometry::Outline& outline, double spacing);

/// The shortest straight edge.
Distance shortest_edge(const geometry::Outline& outline);

}  // namespace plate
