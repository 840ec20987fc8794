#include "fracture/runs/trial.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plate/formulation/heated/heat.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/balance/supports.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/factors/watched_motion.hpp"
#include "post/files/gate.hpp"

namespace fracture {
namespace {

post::AccuracyTrial in_motion(Ready& ready, const plate::Analysis& analysis, const post::SrifOptions& options) {
  constexpr double of_truncation = 0.1;  // of the accuracy
  const auto& plate = *ready.plate;
  const auto reactions = post::Supports(plate.boundary()).elastic_forces(plate);
  ready.motion.emplace(
      post::lanczos_motion(analysis, plate, ready.tip_methods, reactions, of_truncation * *options.accuracy, {}));
  post::AccuracyTrial result{&plate, {}, ready.motion->truncated(), 0, ready.motion->vectors()};
  ready.motion->observe(ready.steps->grid.steps, [&](const plate::Instant& now) {
    ready.stopwatch.lap("solve");
    const auto heat = plate::heat_at(plate, now.time);
    result.rows.push_back(post::srifs(plate, options, ready.tip_methods, now.state, false, &heat));
    result.strain_energy = std::max(result.strain_energy, now.strain_energy);
    ready.stopwatch.lap("srif");
  });
  return result;
}

}  // namespace

FactorsAtRest factors_at_rest(const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
                              const plate::Analysis& analysis, const post::SrifOptions& options,
                              const std::string& when) {
  auto result = plate::static_solution(plate, analysis, {analysis.tolerance, analysis.max_iterations, {}});
  const auto& solution = result.solution;
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e}", when, solution.stop_reason, solution.residual));
  const auto heat = plate::heat_of(plate, 1);
  auto factors = post::srifs(plate, options, methods, result.what_strains(), true, &heat);
  return {std::move(result), std::move(factors)};
}

post::AccuracyTrial trial(Ready& ready, const plate::Analysis& analysis, const post::SrifOptions& options) {
  plate::stop_if_asked("the search for srif.accuracy");
  post::AccuracyTrial result{ready.plate.get(), {}, {}, 0, 0};
  if (analysis.kind == plate::Analysis::Kind::dynamic) {
    result = in_motion(ready, analysis, options);
  } else {
    const auto where = fmt::format("on the way to srif.accuracy, {} points", ready.plate->points());
    auto [equilibrium, factors] = factors_at_rest(*ready.plate, ready.tip_methods, analysis, options, where);
    ready.stopwatch.lap("solve");
    result.strain_energy = ready.plate->strain_energy(equilibrium.what_strains());
    ready.solution = std::move(equilibrium), result.rows = {std::move(factors)};
    ready.stopwatch.lap("srif");
  }
  for (const auto& row : result.rows) post::require_finite(row, "on the way to srif.accuracy");
  return result;
}

}  // namespace fracture
