#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "fracture/runs/keeper.hpp"
#include "post/files/recorder.hpp"

namespace fracture {

/// A folder that a run cannot write to, or cannot go on in.
class RefusedFolder : public std::runtime_error {
public:
  enum class Wish { write, go_on };
  RefusedFolder(Wish wish, const std::string& what) : std::runtime_error(what), wish_(wish) {}
  Wish wish() const { return wish_; }

private:
  Wish wish_;
};

/// Throws RefusedFolder where the folder holds something but no results of a run, or another run writes to it.
void check_folder(const std::filesystem::path& folder);

struct RecordingOptions {
  std::filesystem::path folder;   // made if it does not exist
  std::string resolved, version;  // the whole case as text; of the program
  bool vtk = true, hdf5 = true, velocities = false;
  double checkpoint_every = 0;  // [s]; 0: nothing is kept
  bool goes_on = false;         // from what an earlier run has kept, if it has
  bool quiet = false;
};

/// The summary of such a run that this version of the program has done, with all that came after it: nothing is left to
/// go on with. `report`: one is wanted.
std::optional<post::Summary> done_before(const RecordingOptions& options, bool report);

/// Where the results of a run go, and what it keeps to go on later: none where nothing is kept.
struct Recording {
  post::Recorder recorder;
  std::unique_ptr<Keeper> keeper;
};

/// Of a folder, kept for this run alone. What an earlier run wrote into it goes, and that is said, unless this one goes
/// on from it. Throws RefusedFolder where another run writes to it, or there is a checkpoint and nothing goes on from
/// it.
Recording recording(const RecordingOptions& options);

}  // namespace fracture
