#include "cases/driver/accuracy.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "cases/driver/prepared.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/factors/watched_motion.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/accuracy_search.hpp"
#include "post/report/reactions.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

post::AccuracyTrial trial_in_motion(ValidatedPlate& ready, const plate::Analysis& analysis,
                                    const post::SrifOptions& options) {
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

post::AccuracyTrial trial(ValidatedPlate& ready, const plate::Analysis& analysis, const post::SrifOptions& options) {
  plate::stop_if_asked("the search for srif.accuracy", ready.plate->constraints());
  post::AccuracyTrial result{ready.plate.get(), {}, {}, 0, 0};
  if (analysis.kind == plate::Analysis::Kind::dynamic) {
    result = trial_in_motion(ready, analysis, options);
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

namespace {

CaseFile with_size(const CaseFile& file, double size) {
  CaseFile result = file;
  Case& c = result.content;
  c.discretization = post::discretization_of(file.content, c.analysis.kind == Analysis::Kind::dynamic, size);
  // static factors are to be known far better than by the default tolerance; in motion they are watched themselves
  if (c.analysis.kind == Analysis::Kind::static_) c.analysis.tolerance = std::min(c.analysis.tolerance, 1e-8);
  c.srif->first_ring_only = true;  // errors come from the path
  return result;
}

void warn_of_given_lengths(const CaseFile& file, std::vector<std::string>& warnings) {
  std::string given;
  for (const char* name : {"spacing", "tip_spacing", "hole_spacing", "spacing_growth"})
    for (const auto& [key, where] : file.source.places)
      if (key == fmt::format("discretization.{}", name)) given += (given.empty() ? "" : ", ") + std::string(name);
  if (!given.empty())
    warnings.push_back(
        fmt::format("srif.accuracy finds the lengths of the discretisation: {} of the case not used", given));
}

}  // namespace

Accurate to_accuracy(const CaseFile& file, bool quiet) {
  const auto& options = *file.content.srif;
  Accurate result;
  auto& plate = result.plate;
  plate::Stopwatch before;
  std::optional<CaseError> refused;  // the coarsest points
  post::Progress progress(quiet, "srif.accuracy");
  auto found = post::refine(
      options,
      [&](double size) -> std::variant<post::AccuracyTrial, post::Infeasible> {
        try {
          auto next = std::make_unique<Prepared>(with_size(file, size));
          auto solved = trial(*next, next->file.content.analysis, *next->file.content.srif);
          if (plate) before.add(plate->stopwatch);
          plate = std::move(next);
          return solved;
        } catch (const CaseError& error) {
          const auto& first = error.problems().front();
          const auto& key = first.key;
          if (key == "srif.accuracy" || key.starts_with("analysis.") || key.starts_with("output.")) throw;
          if (!refused) refused = error;
          return post::Infeasible{first.what};
        }
      },
      progress);
  progress.done();
  if (found.summary.path.empty()) throw *refused;
  plate->stopwatch.add(before);
  for (auto& warning : post::warnings_about(found.summary)) plate->warnings.push_back(std::move(warning));
  warn_of_given_lengths(file, plate->warnings);
  result.found = found.summary;
  std::optional<std::vector<double>> truncated;
  if (plate->motion) truncated = plate->motion->truncated();
  result.rows = post::rows_of(std::move(found), truncated, options, file.content.section.thickness);
  return result;
}

}  // namespace cases
