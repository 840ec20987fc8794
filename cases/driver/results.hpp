#pragma once
#include <memory>

#include "cases/driver/run.hpp"
#include "fracture/runs/keeper.hpp"
#include "fracture/runs/run_plan.hpp"
#include "post/files/recorder.hpp"

namespace cases {

struct Case;

/// Throws CaseError where the folder holds something but no results of a run, or another run writes to it.
void check_folder(const std::filesystem::path& folder);

/// A recorder for the results of a case, and what the run keeps to go on later. What an earlier run wrote into its
/// folder goes, and that is said, unless this one goes on from it.
struct Recording {
  post::Recorder recorder;
  std::unique_ptr<fracture::Keeper> keeper;  // none where nothing is kept
};
/// Throws CaseError where the run is to go on from an earlier one that it cannot go on from.
Recording recording_of(const Case& c, const RunOptions& options);

/// What a run of the case, which must outlive it, is to do.
fracture::RunPlan plan_of(const Case& c, const RunOptions& options);

}  // namespace cases
