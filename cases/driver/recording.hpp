#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "cases/input/case_file.hpp"
#include "cases/runs/checkpoints.hpp"
#include "cases/runs/run_plan.hpp"
#include "plate/model/point_map.hpp"
#include "post/files/recorder.hpp"

namespace cases {

/// A folder that a run cannot write to, or cannot go on in.
class RefusedFolder : public std::runtime_error {
public:
  enum class Attempt { write, go_on };
  RefusedFolder(Attempt attempt, const std::string& what) : std::runtime_error(what), attempt_(attempt) {}
  Attempt attempt() const { return attempt_; }

private:
  Attempt attempt_;
};

/// Throws RefusedFolder where the folder holds something but no results of a run, or another run writes to it.
void check_folder(const std::filesystem::path& folder);

/// The case of a run that goes on with the one in its folder, with the rows of that where it gives none: a motion may
/// be longer now. As given where nothing goes on. Throws CaseError where anything else has changed, where steps would
/// be others, and where a motion that is to be longer has left no checkpoint.
CaseFile going_on(const CaseFile& file, const RunOptions& options);

/// The summary of such a run that this version of the program has done, with all that came after it: nothing is left to
/// go on with.
std::optional<post::Summary> done_before(const RunPlan& plan);

/// Recorder of the results of a run, and its checkpoints: null where none are written.
struct Recording {
  post::Recorder recorder;
  std::unique_ptr<RunCheckpoints> checkpoints;
};

/// Recording of a run in memory, or into its folder, which is reserved for this run alone. Files of an earlier run are
/// removed, with a message, unless this run continues from that one. Throws RefusedFolder where another run writes to
/// the folder, or where it has a checkpoint and nothing continues from it.
Recording recording(const RunPlan& plan);

}  // namespace cases
