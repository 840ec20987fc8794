#pragma once
#include "cases/runs/results.hpp"
#include "cases/runs/run_plan.hpp"

namespace cases {

class RunCheckpoints;

/// Runs a plate that is ready, at rest, in motion or for its frequencies, as the plan of the results says: carry_out().
/// `checkpoints`: of a motion that may go on later, or goes on here.
post::Summary run_once(const ValidatedPlate& ready, Results& results, RunCheckpoints* checkpoints = nullptr);

}  // namespace cases
