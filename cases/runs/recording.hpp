#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "plate/model/state.hpp"
#include "plate/solve/archive_types.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/recorder.hpp"

namespace plate {
struct Boundary;
}

namespace fracture {

/// Values of the points that this rank owns: the columns of some states side by side. An empty state is left out.
post::CellValues own_values(const plate::Boundary& boundary, const std::vector<const plate::State*>& states);

/// Sets the columns of owned points in the states from files of any number of ranks (post::write_cells), all others to
/// zero; those states that were empty stay so. Throws std::runtime_error where a point is in none of the files.
void put_values(const plate::Boundary& boundary, const std::vector<std::filesystem::path>& files,
                const std::vector<plate::State*>& states);

}  // namespace fracture

namespace post {
class DistributedCheckpoints;
struct CellValues;
}  // namespace post

namespace fracture {

/// Checkpoints of a run in its folder: saves the state of the run from time to time and restores it. Where a checkpoint
/// cannot be written, the run goes on with a message.
class RunCheckpoints {
public:
  using SaveState = std::function<void(plate::OutArchive&)>;

  /// `every` [s]; from a second on the interval grows so that checkpoints take at most a hundredth of the run.
  RunCheckpoints(post::Checkpoints checkpoints, double every);
  /// Collective, where the plate is distributed: every rank must call each member function.
  RunCheckpoints(std::shared_ptr<post::DistributedCheckpoints> checkpoints, double every);

  /// Looks for a checkpoint to go on from: there is none, or its state waits for restore(). What was wrong with others
  /// goes into `refused`.
  bool find(std::vector<std::string>& refused);
  bool goes_on() const { return !found_.empty(); }
  /// Files with the points of the checkpoint that was found, of a distributed plate.
  const std::vector<std::filesystem::path>& parts() const { return parts_; }
  /// Restores the checkpoint that was found; false where none was.
  bool restore(const std::function<void(plate::InArchive&)>& restore);

  /// True where a checkpoint is due.
  bool due() const;
  /// Writes a checkpoint now, in a distributed plate with the owned points of this rank.
  void save(const SaveState& save_state, const post::CellValues* own = nullptr);
  /// Takes a checkpoint in memory about once a second, and writes it where it is due. `own`: in a distributed plate,
  /// returns the values of the owned points; nothing: none are saved.
  void hold(const SaveState& save_state, const std::function<post::CellValues()>& own = {});
  /// Writes the checkpoint that was last taken.
  void write();

  /// The run has ended: nothing goes on from it.
  void done() const;

private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  void take(const SaveState& save_state);
  void write(const post::CellValues* own);
  /// Collective: true where `here` is true on any rank. Ranks take and write together.
  bool agreed(bool here) const;
  /// The wanted time from one to the next that takes so long.
  Seconds limited_interval(Seconds wanted, Seconds cost) const;

  std::optional<post::Checkpoints> checkpoints_;  // of one of these two
  std::shared_ptr<post::DistributedCheckpoints> together_;
  std::vector<std::filesystem::path> parts_;
  Seconds every_, to_take_{0}, to_write_{0};  // the last: how long it took
  Clock::time_point written_ = Clock::now(), taken_ = {};
  std::string found_, held_;
  std::shared_ptr<const post::CellValues> held_points_;
  bool failed_ = false;
};

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

struct RecordingOptions {
  std::filesystem::path folder;   // made if it does not exist
  std::string resolved, version;  // the whole case as text; of the program
  bool vtk = true, hdf5 = true, velocities = false;
  double checkpoint_every = 0;  // [s]; 0: nothing is kept
  bool goes_on = false;         // from what an earlier run has kept, if it has
  bool quiet = false;
  const plate::Communicator* communicator = &plate::single_process();
};

/// The summary of such a run that this version of the program has done, with all that came after it: nothing is left to
/// go on with. `report`: one is wanted.
std::optional<post::Summary> done_before(const RecordingOptions& options, bool report);

/// Recorder of the results of a run, and its checkpoints: null where none are written.
struct Recording {
  post::Recorder recorder;
  std::unique_ptr<RunCheckpoints> checkpoints;
};

/// Recording into a folder, which is reserved for this run alone. Files of an earlier run are removed, with a message,
/// unless this run continues from that one. Throws RefusedFolder where another run writes to the folder, or where it
/// has a checkpoint and nothing continues from it.
Recording recording(const RecordingOptions& options);

}  // namespace fracture
