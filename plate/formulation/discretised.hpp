#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plate/formulation/formulation.hpp"
#include "plate/model/point_map.hpp"

namespace plate {

/// Seconds spent in the stages of a run, in order.
class Stopwatch {
public:
  /// Time since the last call (or construction) goes to `stage`.
  void lap(const std::string& stage);
  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }
  /// Time spent in the stages of another watch.
  void add(const Stopwatch& other);
  /// Adds the stages of another watch, and goes on from the time at which that one ended.
  void follow(const Stopwatch& other) { add(other), last_ = other.last_; }
  double seconds(const std::string& stage) const;
  double total() const;

private:
  void add(const std::string& stage, double spent);

  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> seconds_;
};

/// A problem turned into a plate, with what its user should know, and the seconds that it took.
struct Discretised {
  std::unique_ptr<Formulation> plate;
  std::unique_ptr<Formulation> membrane;  // the same points in their plane, where loads act there
  std::vector<std::string> warnings;
  Stopwatch stopwatch;
};

/// Discretises a problem by its formulation. Throws Refused where it cannot carry the problem, or the machine has no
/// memory for so many points. Whether the plate is held is not checked here.
Discretised discretise(const Problem& problem, const Communicator& communicator = single_process());

/// Throws Refused where the machine has not even the memory for the points, as discretise() does.
void require_memory(const Problem& problem);

}  // namespace plate
