#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "plate/solve/archive_types.hpp"
#include "post/files/sinks/checkpoint.hpp"

namespace fracture {

/// Keeps what a run must remember in its folder, from time to time, and gives back what was kept there.
class Keeper {
public:
  /// `every` [s].
  Keeper(post::Checkpoints checkpoints, double every);

  /// Looks for a checkpoint to go on from: there is none, or its memory waits for recall(). What was wrong with others
  /// goes into `refused`.
  bool find(std::vector<std::string>& refused);
  bool goes_on() const { return !memory_.empty(); }

  /// Is it time to keep?
  bool due() const;
  /// Throws std::filesystem::filesystem_error.
  void keep(const std::function<void(plate::OutArchive&)>& remember);
  /// What was found; false where nothing was.
  bool recall(const std::function<void(plate::InArchive&)>& recall);

  /// The run has ended: nothing goes on from it.
  void done() const { checkpoints_.remove(); }

private:
  using Clock = std::chrono::steady_clock;

  post::Checkpoints checkpoints_;
  std::chrono::duration<double> every_;
  Clock::time_point last_ = Clock::now();
  std::string memory_;
};

}  // namespace fracture
