#pragma once
#include "cases/runs/run_plan.hpp"
#include "post/files/recorder.hpp"

namespace fracture {

struct RunPlan;

/// Computes the harmonic (steady-state) response of a damped plate under loads that vary as cos(2 pi f t), at every
/// frequency f of a sweep: factors and probes at each, and a period in eight frames where the deflection is largest.
/// Throws plate::NumericalError or plate::Interrupted after the results so far have been written.
post::Summary run_response(const ValidatedPlate& ready, const RunPlan& plan, post::Recorder recorder,
                           plate::Stopwatch& stopwatch);

}  // namespace fracture
