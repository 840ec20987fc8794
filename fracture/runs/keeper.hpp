#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plate/solve/archive_types.hpp"
#include "post/files/sinks/checkpoint.hpp"

namespace post {
class SharedCheckpoints;
struct CellValues;
}  // namespace post

namespace fracture {

/// Keeps what a run must remember in its folder, from time to time, and gives back what was kept there. Where that
/// cannot be written the run goes on, with a word.
class Keeper {
public:
  using Remember = std::function<void(plate::OutArchive&)>;

  /// `every` [s]; from a second on it is stretched so that all that this does takes a hundredth of the run.
  Keeper(post::Checkpoints checkpoints, double every);
  /// Of one of the processes that share a plate: all call everything at once.
  Keeper(std::shared_ptr<post::SharedCheckpoints> checkpoints, double every);

  /// Looks for a checkpoint to go on from: there is none, or its memory waits for recall(). What was wrong with others
  /// goes into `refused`.
  bool find(std::vector<std::string>& refused);
  bool goes_on() const { return !found_.empty(); }
  /// The points of what was found, where processes share the plate.
  const std::vector<std::filesystem::path>& parts() const { return parts_; }
  /// What was found; false where nothing was.
  bool recall(const std::function<void(plate::InArchive&)>& recall);

  /// Is it time to keep?
  bool due() const;
  /// Writes a checkpoint now, where processes share the plate with the points of this one.
  void keep(const Remember& remember, const post::CellValues* own = nullptr);
  /// Takes the memory, about once a second, and writes it where it is time. `own`: where processes share the plate,
  /// makes the points of this one; nothing: none are kept.
  void hold(const Remember& remember, const std::function<post::CellValues()>& own = {});
  /// Writes what was last taken.
  void write();

  /// The run has ended: nothing goes on from it.
  void done() const;

private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  void take(const Remember& remember);
  void write(const post::CellValues* own);
  /// Where processes share the plate, is it so in one of them? They take and write together.
  bool agreed(bool here) const;
  /// The wanted time from one to the next that takes so long.
  Seconds stretched(Seconds wanted, Seconds cost) const;

  std::optional<post::Checkpoints> checkpoints_;  // of one of these two
  std::shared_ptr<post::SharedCheckpoints> together_;
  std::vector<std::filesystem::path> parts_;
  Seconds every_, to_take_{0}, to_write_{0};  // the last: how long it took
  Clock::time_point written_ = Clock::now(), taken_ = {};
  std::string found_, held_;
  std::shared_ptr<const post::CellValues> held_points_;
  bool failed_ = false;
};

}  // namespace fracture
