#pragma once
#include <string>

#include "cases/input/case_file.hpp"
#include "cases/runs/cost_estimate.hpp"

namespace cases {

/// Estimates a run from samples, which write to a folder that is removed. Throws CaseError where no sample of up to
/// 50,000 points can carry the case, and neither can the case itself.
RunEstimate estimate_cost(const CaseFile& file);

/// Names the other method of a motion, where the estimate is clearly less than these `seconds`; else "".
std::string cheaper_way(const CaseFile& file, double seconds);

/// Estimates the cost of a run, as text: points, bonds, memory, time step, steps. Writes nothing. Throws CaseError.
/// `processes`: number that are to share the plate; 0: the run is by this program alone.
std::string cost(const CaseFile& file, int processes = 0);

}  // namespace cases
