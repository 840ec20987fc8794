#pragma once
#include "plate/formulation/formulation.hpp"
#include "plate/galerkin/levels.hpp"
#include "plate/model/ranks/ranks.hpp"

namespace plate {

/// Points of all processes that share a plate.
std::size_t points_of_all(const Boundary& boundary);

/// The same plate on points two, four, ... times as far apart, as long as there are enough of them for all processes:
/// each level is shared out by itself, and every process has what its points of the finer one take from it. `seen`:
/// geometry::seen_positions() of the plate's points. All call it at once.
std::vector<GalerkinLevel> coarser_parts(const Ranks& all, const Formulation& plate,
                                         const std::vector<geometry::Point>& seen);

}  // namespace plate
