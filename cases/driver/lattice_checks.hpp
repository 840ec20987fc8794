#pragma once
#include "cases/input/case_file.hpp"
#include "geometry/lattice/cloud.hpp"

namespace cases {

/// What a lattice of points cannot carry of a case (bonds over a horizon): parts of the plate that have no points
/// because they are no wider than a spacing, loaded edges without points, pins, point forces and probes that would move
/// by more than a spacing, supports that act on less than one, pins so near one line that the places of the points
/// decide. Throws CaseError with all of them, or adds warnings. `cells`: the outline in the cloud's units.
void check_lattice(const CaseFile& file, const geometry::Cloud& cloud, const geometry::Outline& cells,
                   std::vector<std::string>& warnings);

}  // namespace cases
