#pragma once
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/tip_methods.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/summary.hpp"

namespace plate {
struct BucklingMode;
}

namespace cases {

class Outputs;
class PlateAnalysis;
class RunCheckpoints;
struct Case;

/// A plate with all that can be refused of its run behind it: nothing has been written yet.
struct ValidatedPlate {
  struct Steps {
    double limit;
    plate::TimeGrid grid;
  };
  plate::Stopwatch stopwatch;
  std::unique_ptr<plate::Formulation> plate;
  /// Where loads act there, the middle plane stretches, bending and stretching are coupled, or faces of cracks touch.
  std::unique_ptr<plate::Formulation> membrane;
  std::vector<std::string> warnings;
  std::vector<post::TipMethods> tip_methods, membrane_methods;
  post::OtherFactors other_factors;
  std::optional<Steps> steps;  // of a motion; without a limit where it takes no steps but rows
  plate::BeginOfMotion begin;
  // of a plate that has been solved already:
  std::optional<plate::StaticResult> solution, solution_in_plane;
  std::optional<plate::LanczosMotion> motion;
  std::vector<std::vector<post::Srif>> factors;  // at all times: of each tip what all sizes tend to, then of this plate
  std::vector<post::Srif> factors_in_plane;      // of a plate at rest: N1 and N2 as K1 and K2, among `factors` too
  std::optional<post::AccuracySummary> accuracy;       // of the search for its discretisation
  std::vector<post::OtherResults> other_results = {};  // where errors of results are wanted
  std::optional<post::TargetsSummary> targets = {};    // likewise, to a stated accuracy
};

/// Runs a plate as the plan of the outputs says: by load cases, at rest, in motion, for its frequencies or its harmonic
/// response. `checkpoints`: of a motion that may go on later, or goes on here. Throws as carry_out().
post::Summary run(const ValidatedPlate& ready, Outputs& outputs, RunCheckpoints* checkpoints = nullptr);

/// Load cases and their combinations, one after the other on a plate that is made once: the number of each, from 1,
/// stands in the place of time. Combinations are sums of states.
std::unique_ptr<PlateAnalysis> load_cases(const ValidatedPlate& ready, Outputs& outputs);

/// Harmonic (steady-state) response of a damped plate under loads that vary as cos(2 pi f t), at every frequency f of a
/// sweep: factors, probes and reactions at each, and a period in eight frames where the deflection is largest.
std::unique_ptr<PlateAnalysis> harmonic_response(const ValidatedPlate& ready, Outputs& outputs);

/// Equilibrium with large deflections (von Karman).
std::unique_ptr<PlateAnalysis> large_deflections(const ValidatedPlate& ready, Outputs& outputs);

/// Equilibrium of a plate whose bending and stretching are coupled (plate::Problem::coupled()).
std::unique_ptr<PlateAnalysis> coupled_plate(const ValidatedPlate& ready, Outputs& outputs);

/// Motion under loads in the plane or with large deflections. `checkpoints`: as run().
std::unique_ptr<PlateAnalysis> stretched_motion(const ValidatedPlate& ready, Outputs& outputs,
                                                RunCheckpoints* checkpoints);

/// Estimated errors of buckling factors, from those with twice the spacing: half the difference, as errors fall with
/// the square of the spacing, and 1.5 times it beside the tips of cracks, where they fall with the spacing. Absent
/// where no such plate, or mode, can be had. `all`: the ranks that share the plates.
std::vector<std::optional<double>> errors_of_buckling(const Case& c, const std::vector<plate::BucklingMode>& found,
                                                      const plate::Communicator& all = plate::single_process());

/// Frequencies and shapes of a plate, also under its membrane forces.
std::unique_ptr<PlateAnalysis> frequencies(const ValidatedPlate& ready, Outputs& outputs);

/// Loads in the plane at which a flat plate buckles, and its shapes then.
std::unique_ptr<PlateAnalysis> buckling(const ValidatedPlate& ready, Outputs& outputs);

}  // namespace cases
