#pragma once
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"

namespace plate {

/// True for a point in the plate, or on its boundary.
bool on_plate(const geometry::Outline& outline, const geometry::Point& point);

/// Edges that supports and loads name and that the plate does not have, edges that two supports hold or that a kind of
/// support cannot hold, pinned points beside the plate, patches and lines of loads that do not lie on it, and positions
/// of loads that do not lie inside it: of those that have none, too.
std::vector<Refusal> errors_in_edges(const Problem& problem);

/// Faults of a problem with loads by temperature: a section without thermal expansion, edges and corrections of bonds
/// under which a bent plate is not free of stress.
std::vector<Refusal> errors_in_heat(const Problem& problem);

}  // namespace plate
