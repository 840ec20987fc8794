#pragma once
#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/runs/recording.hpp"
#include "cases/runs/run_plan.hpp"

namespace cases {

struct Case;

RecordingOptions recording_options(const Case& c, const RunOptions& options);
/// Returns where the results of a run of the case go. Throws RefusedFolder.
Recording recording_of(const Case& c, const RunOptions& options);

/// Plan of a run of the case, which must outlive it.
RunPlan plan_of(const Case& c, const RunOptions& options);

/// The case in the other formulation, without files for fields. Settings that only one formulation has take their
/// defaults. Throws CaseError where the case cannot be stated in it.
CaseFile in_other_formulation(const CaseFile& file);

}  // namespace cases
