#pragma once
#include "cases/driver/run.hpp"
#include "fracture/runs/recording.hpp"
#include "fracture/runs/run_plan.hpp"

namespace cases {

struct Case;

fracture::RecordingOptions recording_options(const Case& c, const RunOptions& options);
/// Where the results of a run of the case go. Throws fracture::RefusedFolder.
fracture::Recording recording_of(const Case& c, const RunOptions& options);

/// What a run of the case, which must outlive it, is to do.
fracture::RunPlan plan_of(const Case& c, const RunOptions& options);

}  // namespace cases
