#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "plate/model/state.hpp"
#include "plate/solve/archive_types.hpp"
#include "post/files/checkpoints.hpp"

namespace plate {
struct Boundary;
}

namespace cases {

/// Values of the points that this rank saves, the columns of some states side by side: of the points of the plate that
/// it owns; where one process holds the whole plate, of all points. An empty state is left out.
post::CellValues own_values(const plate::Boundary& boundary, const std::vector<const plate::State*>& states);

/// A state to be restored.
struct RestoredState {
  plate::State* state;
  /// Computes the columns that this rank does not save from those that it saves; absent: they stay zero.
  std::function<void(plate::State&)> complete = {};
};

/// Sets the columns that this rank saves from files of any number of ranks (post::write_cells), and completes the
/// states; those that were empty at the end stay so. Throws std::runtime_error where a point is in none of the files.
void put_values(const plate::Boundary& boundary, const std::vector<std::filesystem::path>& files,
                const std::vector<RestoredState>& states);

/// Checkpoints of a run in its folder: saves the state of the run from time to time and restores it. Where a checkpoint
/// cannot be written, the run goes on with a message. Collective: every rank must call each member function.
class RunCheckpoints {
public:
  using SaveState = std::function<void(plate::OutArchive&)>;
  using OwnValues = std::function<post::CellValues()>;  // of the points that this rank saves

  /// `every` [s]; from a second on the interval grows so that checkpoints take at most a hundredth of the run.
  RunCheckpoints(post::Checkpoints checkpoints, double every) : checkpoints_(std::move(checkpoints)), every_(every) {}

  /// Looks for a checkpoint to go on from: there is none, or its state waits for restore(). What was wrong with others
  /// goes into `refused`.
  bool find(std::vector<std::string>& refused);
  bool goes_on() const { return !found_.memory.empty(); }
  /// Files with the points of the checkpoint that was found.
  const std::vector<std::filesystem::path>& parts() const { return found_.parts; }
  /// Restores the checkpoint that was found; false where none was.
  bool restore(const std::function<void(plate::InArchive&)>& restore);

  /// True where a checkpoint is due.
  bool due() const;
  /// Writes a checkpoint now.
  void save(const SaveState& save_state, const OwnValues& own);
  /// Takes a checkpoint in memory about once a second, and writes it where it is due.
  void hold(const SaveState& save_state, const OwnValues& own);
  /// Writes the checkpoint that was last taken.
  void write();

  /// The run has ended: nothing goes on from it.
  void done() const { checkpoints_.remove(); }
  /// The run has ended: one for longer may go on from its last checkpoint.
  void keep_last() const { checkpoints_.keep_last(); }

private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  void take(const SaveState& save_state, const OwnValues& own);
  /// Collective: true where `here` is true on any rank. Ranks take and write together.
  bool agreed(bool here) const { return checkpoints_.agreed(here); }
  /// The wanted time from one to the next that takes so long.
  Seconds limited_interval(Seconds wanted, Seconds cost) const;

  post::Checkpoints checkpoints_;
  post::Checkpoints::Found found_;
  Seconds every_, to_take_{0}, to_write_{0};  // the last: how long it took
  Clock::time_point written_ = Clock::now(), taken_ = {};
  std::string held_;
  post::CellValues held_points_;
  bool failed_ = false;
};

}  // namespace cases
