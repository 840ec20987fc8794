#pragma once
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/refused.hpp"

namespace plate {

struct Problem;

/// In the plate, or on its boundary?
bool on_plate(const geometry::Outline& outline, const geometry::Point& point);

/// Edges that supports and loads name and that the plate does not have, edges that two supports hold or that a kind of
/// support cannot hold, pinned points beside the plate, patches and lines of loads that do not lie on it, and positions
/// of loads that do not lie inside it: of those that have none, too.
std::vector<Refusal> faults_of_edges(const Problem& problem);

}  // namespace plate
