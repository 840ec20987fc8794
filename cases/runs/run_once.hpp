#pragma once
#include "cases/runs/results.hpp"
#include "cases/runs/run_plan.hpp"

namespace fracture {

class RunCheckpoints;

/// Runs a plate that is ready, at rest, in motion or for its frequencies, as the plan of the results says: whatever it
/// does goes to them as it comes, and the summary at last. Throws plate::NumericalError or plate::Interrupted after
/// that. `checkpoints`: of a motion that may go on later, or goes on here.
post::Summary run_once(const ValidatedPlate& ready, Results& results, plate::Stopwatch& stopwatch,
                       RunCheckpoints* checkpoints = nullptr);

}  // namespace fracture
