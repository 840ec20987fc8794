#pragma once
#include <functional>
#include <optional>

#include "fracture/runs/run_plan.hpp"
#include "plate/usual_solver.hpp"
#include "post/studies/foretold.hpp"

namespace fracture {

/// What a run will be, told from runs of samples: the same with fewer points.
struct ForetoldRun {
  double points = 0, bonds = 0;
  plate::UsualSolver solver;             // of statics
  double time_step = 0, time_limit = 0;  // of a motion that takes steps
  post::WholeRun whole;
  post::Foretold costs;
  double bytes = 0;                        // of memory at its peak
  std::size_t sample_points = 0;           // of the larger sample
  std::optional<double> multipliers = {};  // of that sample (Formulation::multipliers)
};

/// Of the points, cells and loads of a Galerkin plate beside its weights, while it is made, for each point; measured 94
/// to 98 from 250,000 to 1 million points of a lattice.
constexpr double bytes_while_cells_are_made = 95;

/// How much less a sample does.
struct Less {
  double wider = 1;  // spacings
  bool factors = false;
  double steps = 1, time_step = 0;  // of a motion; 0: not known yet
  bool solves = false;              // to the tolerance of the analysis
};

/// Runs a sample; nothing where such wide points cannot carry it. Throws plate::NumericalError, and what it likes where
/// its points are those of the plan.
using RunSample = std::function<std::optional<post::SampleRun>(const plate::UsualSolver& solver, const Less& less)>;

/// Samples of up to 50,000 points, or of as many as it takes. Throws plate::Refused where a motion has too many steps,
/// and what `run` throws where no sample can be had.
ForetoldRun foretell(const RunPlan& plan, const RunSample& run);

/// About how many points a plate will have, told without it.
double expected_points(const plate::Problem& problem);

/// Points that are so much wider apart, and graded as much.
plate::Discretization widened(plate::Discretization points, double wider);

/// The analysis of a sample: by the solver that the whole plate takes, and in motion as many steps as it is asked for.
plate::Analysis sampled(plate::Analysis analysis, const plate::UsualSolver& solver, const Less& less, bool grows);

/// A sample that has been run, as far as its plan and summary tell.
post::SampleRun sample_run(const RunPlan& sample, post::Summary summary, double wider);

/// Points, bonds, the way to the solution and time, in words.
std::string to_text(const ForetoldRun& run, const RunPlan& plan);

}  // namespace fracture
