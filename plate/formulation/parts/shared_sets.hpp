#pragma once
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/parts/disjoint_sets.hpp"

namespace plate {

/// The number of the set of every point: its root; where processes share the plate, the same in all of them for sets
/// that are one through points that several see. All processes call it at once.
std::vector<std::int64_t> set_numbers(DisjointSets& sets, const Boundary& boundary);

}  // namespace plate
