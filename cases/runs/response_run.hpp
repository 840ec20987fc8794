#pragma once
#include "cases/runs/run_plan.hpp"
#include "post/files/recorder.hpp"

namespace fracture {

struct RunPlan;

/// What a damped plate does for ever under loads that go as cos(2 pi f t), at every frequency f of a sweep: factors and
/// probes at each, and a period in eight frames where the deflection is largest. Throws plate::NumericalError or
/// plate::Interrupted after what there is has been written.
post::Summary run_response(const Ready& ready, const RunPlan& plan, post::Recorder recorder,
                           plate::Stopwatch& stopwatch);

}  // namespace fracture
