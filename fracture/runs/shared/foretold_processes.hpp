#pragma once
#include <string>
#include <utility>
#include <vector>

namespace plate {
struct Problem;
}

namespace fracture {

struct ForetoldRun;
struct RunPlan;

/// What each of some processes will have of a plate that they share, told from its outline; the numbers are of the one
/// that has the most.
struct ForetoldProcesses {
  int count = 1;
  double points = 0, least_points = 0;  // of its own
  double seen = 0;                      // with what it sees of others'
  double copies = 0, neighbours = 0;    // others' points whose values come to it, and from how many
  bool all_made = false;                // each makes all points and cells, and keeps those that it sees
};

/// @throws plate::Refused  more processes than blocks of the lattice
ForetoldProcesses foretold_processes(const plate::Problem& problem, int count);

/// A run by one process, as it is foretold.
struct RunByOne {
  double points = 0, program = 0, bytes = 0;            // memory at its peak: of the program, and of the plate
  double factor = 0;                                    // of that a factor of the whole plate
  std::vector<std::pair<std::string, double>> seconds;  // of its stages
  bool moves = false;
  // of a step or an iteration: to each neighbour, and for each point whose values come to it
  double messages = 0, numbers = 0;
};
RunByOne run_by_one(const ForetoldRun& run, const RunPlan& plan);

/// Peak memory of a process [bytes].
double bytes_of_process(const ForetoldProcesses& processes, const RunByOne& run);
/// Time of a run by these, where each has cores of its own, as many as threads of the samples; without exchange [s].
double seconds_of_processes(const ForetoldProcesses& processes, const RunByOne& run);

/// Points, memory, time and exchange, in words.
std::string to_text(const ForetoldProcesses& processes, const RunByOne& run);

}  // namespace fracture
