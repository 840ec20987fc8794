#pragma once
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace plate {

/// Seconds spent in the stages of a run, in order.
class Stopwatch {
public:
  /// Time since the last call (or construction) goes to `stage`.
  void lap(const std::string& stage);
  const std::vector<std::pair<std::string, double>>& seconds() const { return seconds_; }
  /// Time spent in the stages of another watch.
  void add(const Stopwatch& other);
  /// The same, and goes on where it ended.
  void follow(const Stopwatch& other) { add(other), last_ = other.last_; }
  double seconds(const std::string& stage) const;
  double total() const;

private:
  void add(const std::string& stage, double spent);

  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> seconds_;
};

}  // namespace plate
