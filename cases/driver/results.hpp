#pragma once
#include "cases/driver/run.hpp"
#include "fracture/runs/run_plan.hpp"
#include "post/files/recorder.hpp"

namespace cases {

struct Case;

/// Throws CaseError where the folder holds something but no results of a run.
void check_folder(const std::filesystem::path& folder);

/// A recorder for the results of a case. What an earlier run wrote into its folder goes, and that is said.
post::Recorder recorder_of(const Case& c, const RunOptions& options);

/// What a run of the case, which must outlive it, is to do.
fracture::RunPlan plan_of(const Case& c, const RunOptions& options);

}  // namespace cases
