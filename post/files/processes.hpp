#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plate {
class Communicator;
struct Traffic;
}  // namespace plate

namespace post {

/// Spread over all ranks of a number that each rank has.
struct Spread {
  double least = 0, mean = 0, largest = 0;
};

/// Distribution of a run among processes.
struct ProcessesSummary {
  std::size_t count = 0, threads = 0;                   // threads: of each
  Spread points;                                        // of the plate
  Spread memory;                                        // largest resident [bytes]
  std::vector<std::pair<std::string, Spread>> seconds;  // of the stages
  Spread waiting;                                       // [s] in exchanges and sums: Traffic::seconds
  // what comes to a process, over the steps or iterations of the run
  std::optional<double> steps;
  Spread messages, bytes, sums;
};

/// The ranks of a run, and what they send each other from the construction of this on.
class ProcessesOfRun {
public:
  ProcessesOfRun();  // of one process
  /// `all` must outlive this.
  explicit ProcessesOfRun(const plate::Communicator& all);

  /// True in the first of them.
  bool first() const;

  /// Summary of all ranks, from the values of each; null where one process holds the whole plate. Collective: every
  /// rank must call it. `points`: of the rank; `seconds`: of its stages; `steps`: or iterations.
  std::shared_ptr<const ProcessesSummary> summary(std::size_t points,
                                                  const std::vector<std::pair<std::string, double>>& seconds,
                                                  double memory, std::optional<double> steps) const;

private:
  const plate::Communicator* all_;
  std::shared_ptr<const plate::Traffic> before_;
};

/// Returns the summary as three lines for people.
std::string printed(const ProcessesSummary& processes);

}  // namespace post
