#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plate/formulations.hpp"
#include "post/report/cost_model.hpp"

namespace cases {

struct Case;

/// Estimate of a run, from runs of samples: the same with fewer points.
struct RunEstimate {
  double points = 0, bonds = 0;
  plate::UsualSolver solver;             // of statics
  double time_step = 0, time_limit = 0;  // of a motion that takes steps
  post::RunSize whole;
  post::CostEstimate costs;
  double bytes = 0;                        // of memory at its peak
  std::size_t sample_points = 0;           // of the larger sample
  std::optional<double> multipliers = {};  // of that sample (Formulation::multipliers)
  // of that sample in statics: Summary::linear_theory_off and deflection_over_thickness
  std::optional<double> linear_theory_off = {}, deflection_over_thickness = {};
};

/// Memory per point [bytes] of the points, cells and loads of a Galerkin plate beside its weights, while it is made;
/// measured 94 to 98 from 250,000 to 1 million points of a lattice.
constexpr double bytes_while_cells_are_made = 95;

/// Reductions of a sample against the run whose cost is estimated.
struct ReducedRun {
  double wider = 1;  // spacings
  bool factors = false;
  double steps = 1, time_step = 0;  // of a motion; 0: not known yet
  bool solves = false;              // to the tolerance of the analysis
};

/// Runs a sample; nothing where such wide points cannot carry it. Throws plate::NumericalError, and what it likes where
/// its points are those of the case.
using RunSample =
    std::function<std::optional<post::SampleRun>(const plate::UsualSolver& solver, const ReducedRun& reduced)>;

/// Samples of up to 50,000 points, or of as many as it takes. Throws plate::Refused where a motion has too many steps,
/// and what `run` throws where no sample can be had.
RunEstimate estimate_cost(const Case& c, const RunSample& run);

/// Estimates the number of points of a plate without discretising it.
double expected_points(const plate::Problem& problem);

/// The analysis of a sample: by the solver that the whole plate takes, and in motion as many steps as it is asked for.
plate::Analysis sampled(plate::Analysis analysis, const plate::UsualSolver& solver, const ReducedRun& reduced,
                        bool grows);

/// A sample that has been run, as far as its case and summary tell.
post::SampleRun sample_run(const Case& c, post::Summary summary, double wider);

/// Points, bonds, the way to the solution and time, in words.
std::string to_text(const RunEstimate& run, const Case& c);

/// Estimated share of each process in a plate that several share, from its outline; the numbers are of the process that
/// has the most.
struct ProcessesEstimate {
  int count = 1;
  double points = 0, least_points = 0;  // of its own
  double seen = 0;                      // with what it sees of others'
  double copies = 0, neighbours = 0;    // others' points whose values come to it, and from how many
  bool all_made = false;                // each makes all points and cells, and keeps those that it sees
};

/// @throws plate::Refused  more processes than blocks of the lattice
ProcessesEstimate estimated_processes(const plate::Problem& problem, int count);

/// Estimated cost of a run by one process.
struct SingleProcessRun {
  double points = 0, program = 0, bytes = 0;            // memory at its peak: of the program, and of the plate
  double factor = 0;                                    // of that a factor of the whole plate
  std::vector<std::pair<std::string, double>> seconds;  // of its stages
  bool moves = false;
  // of a step or an iteration: to each neighbour, and for each point whose values come to it
  double messages = 0, numbers = 0;
};
SingleProcessRun run_by_one(const RunEstimate& run, const Case& c);

/// Peak memory of a process [bytes].
double bytes_of_process(const ProcessesEstimate& processes, const SingleProcessRun& run);
/// Time of a run by these, where each has cores of its own, as many as threads of the samples; without exchange [s].
double seconds_of_processes(const ProcessesEstimate& processes, const SingleProcessRun& run);

/// Points, memory, time and exchange, in words.
std::string to_text(const ProcessesEstimate& processes, const SingleProcessRun& run);

}  // namespace cases
