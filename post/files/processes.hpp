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

/// Summary of all ranks, from the values of each; null where one process holds the whole plate. Collective: every rank
/// must call it. `points`: of the rank; `seconds`: of its stages; `since`: traffic of the run; `steps`: or iterations.
std::shared_ptr<const ProcessesSummary> of_processes(const plate::Communicator& all, std::size_t points,
                                                     const std::vector<std::pair<std::string, double>>& seconds,
                                                     double memory, const plate::Traffic& since,
                                                     std::optional<double> steps);

/// The traffic of this rank so far; zeros where one process has all.
plate::Traffic traffic_so_far(const plate::Communicator& all);

/// Returns the summary as three lines for people.
std::string printed(const ProcessesSummary& processes);

}  // namespace post
