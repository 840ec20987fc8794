#pragma once
#include <optional>
#include <vector>

#include "cases/runs/run_plan.hpp"
#include "post/files/recorder.hpp"

namespace fracture {

struct RunPlan;

/// The load cases of a plan and their combinations, one after the other on a plate that is made once: the number of
/// each, from 1, stands in the place of time. Combinations are sums of states. Throws plate::NumericalError or
/// plate::Interrupted after what there is has been written.
post::Summary run_load_cases(const ValidatedPlate& ready, const RunPlan& plan, post::Recorder recorder,
                             plate::Stopwatch& stopwatch);

}  // namespace fracture
