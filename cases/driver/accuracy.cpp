#include "cases/driver/accuracy.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>

#include "cases/driver/prepared.hpp"
#include "cases/driver/recording.hpp"
#include "cases/input/formulations.hpp"
#include "cases/runs/cost_estimate.hpp"
#include "cases/runs/membrane.hpp"
#include "cases/runs/outputs.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/factors/watched_motion.hpp"
#include "post/files/result_checks.hpp"
#include "post/files/results_in_memory.hpp"
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

/// Solves a plate at rest. Throws plate::NumericalError, with these words, where no equilibrium is found.
plate::StaticResult solved_at_rest(const plate::Formulation& plate, const plate::Analysis& analysis,
                                   const std::string& when) {
  auto result = plate::static_solution(plate, analysis, {analysis.tolerance, analysis.max_iterations, {}});
  const auto& solution = result.solution;
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e}", when, solution.stop_reason, solution.residual));
  return result;
}

/// Corrects factors of tips at which faces of a crack touch; those in the plane are N1 and N2 as K1 and K2.
void close_tips(std::vector<post::Srif>& bending, std::vector<post::Srif>& in_plane,
                const std::vector<post::ClosedTip>& closed, const plate::Section& section) {
  post::add_membrane(bending, in_plane, section);
  post::close(bending, closed, section);
  for (auto& srif : bending) {
    const auto same = [&](const post::Srif& one) { return one.tip == srif.tip && one.method == srif.method; };
    const auto found = std::ranges::find_if(in_plane, same);
    if (found == in_plane.end() || !srif.membrane) continue;
    const auto& [N, errors, resolved, G, thickness] = *srif.membrane;
    found->K1 = N[0], found->K2 = N[1], found->G = G;
    for (std::size_t i = 0; i < N.size(); ++i) found->errors[i] = errors[i], found->resolved[i] = resolved[i];
  }
}

/// Solves a plate at rest with contact of the faces of its cracks. The solution without contact stays with it.
post::AccuracyTrial trial_in_contact(ValidatedPlate& ready, const plate::Analysis& analysis,
                                     const post::SrifOptions& options, const std::string& when) {
  const auto &plate = *ready.plate, &membrane = *ready.membrane;
  ready.solution = solved_at_rest(plate, analysis, when);
  auto bending = *ready.solution;
  const std::optional wanted(options);
  auto found = with_contact(plate, membrane, analysis, {wanted, ready.membrane_methods}, bending);
  ready.stopwatch.lap("solve");
  const auto heat = plate::heat_of(plate, 1);
  auto factors = post::srifs(plate, options, ready.tip_methods, bending.what_strains(), true, &heat);
  close_tips(factors, found.in_plane.factors, found.faces.closed, plate.section());
  post::AccuracyTrial result{&plate, {}, {}, plate.strain_energy(bending.what_strains()), 0};
  result.rows = {std::move(factors)}, result.rows_in_plane = {std::move(found.in_plane.factors)};
  result.energy_in_plane = found.in_plane.summary.strain_energy - found.in_plane.stored;
  ready.stopwatch.lap("srif");
  return result;
}

}  // namespace

FactorsAtRest factors_at_rest(const plate::Formulation& plate, const std::vector<post::TipMethods>& methods,
                              const plate::Analysis& analysis, const post::SrifOptions& options,
                              const std::string& when) {
  auto result = solved_at_rest(plate, analysis, when);
  const auto heat = plate::heat_of(plate, 1);
  auto factors = post::srifs(plate, options, methods, result.what_strains(), true, &heat);
  return {std::move(result), std::move(factors)};
}

post::AccuracyTrial trial(ValidatedPlate& ready, const plate::Analysis& analysis, const post::SrifOptions& options) {
  plate::stop_if_asked("the search for srif.accuracy", ready.plate->constraints());
  const auto where = fmt::format("on the way to srif.accuracy, {} points", ready.plate->points());
  const bool touch = ready.plate->problem().faces_touch();
  post::AccuracyTrial result{ready.plate.get(), {}, {}, 0, 0};
  if (analysis.kind == plate::Analysis::Kind::dynamic) {
    result = trial_in_motion(ready, analysis, options);
  } else if (touch) {
    result = trial_in_contact(ready, analysis, options, where);
  } else {
    auto [equilibrium, factors] = factors_at_rest(*ready.plate, ready.tip_methods, analysis, options, where);
    ready.stopwatch.lap("solve");
    result.strain_energy = ready.plate->strain_energy(equilibrium.what_strains());
    ready.solution = std::move(equilibrium), result.rows = {std::move(factors)};
    ready.stopwatch.lap("srif");
  }
  if (const auto& membrane = ready.membrane; membrane && !touch) {
    auto [equilibrium, factors] = factors_at_rest(*membrane, ready.membrane_methods, analysis, options,
                                                  "in the plane on the way to srif.accuracy");
    result.energy_in_plane = membrane->strain_energy(equilibrium.solution.state);
    ready.solution_in_plane = std::move(equilibrium), result.rows_in_plane = {std::move(factors)};
    ready.stopwatch.lap("srif");
  }
  for (const auto* rows : {&result.rows, &result.rows_in_plane})
    for (const auto& row : *rows) post::require_finite(row, "on the way to srif.accuracy");
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

}  // namespace

void warn_of_given_lengths(const CaseFile& file, const char* by, std::vector<std::string>& warnings) {
  std::string given;
  for (const char* name : {"spacing", "tip_spacing", "hole_spacing", "spacing_growth"})
    for (const auto& [key, where] : file.source.places)
      if (key == fmt::format("discretization.{}", name)) given += (given.empty() ? "" : ", ") + std::string(name);
  if (!given.empty())
    warnings.push_back(fmt::format("{} finds the lengths of the discretisation: {} of the case not used", by, given));
}

std::unique_ptr<Prepared> to_accuracy(const CaseFile& file, bool quiet) {
  const auto& options = *file.content.srif;
  std::unique_ptr<Prepared> plate;
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
  warn_of_given_lengths(file, "srif.accuracy", plate->warnings);
  plate->accuracy = found.summary;
  std::optional<std::vector<double>> truncated;
  if (plate->motion) truncated = plate->motion->truncated();
  const auto& section = file.content.section;
  auto [rows, in_plane] = post::rows_of(std::move(found), truncated, options, section.thickness);
  for (std::size_t i = 0; i < in_plane.size(); ++i) post::add_membrane(rows[i], in_plane[i], section);
  plate->factors = std::move(rows);
  if (!in_plane.empty()) plate->factors_in_plane = std::move(in_plane.front());
  return plate;
}

namespace {

/// Warns of tips at which no method has room at twice the spacing.
void warn_of_small_room(const std::vector<bool>& works, double spacing, std::vector<std::string>& warnings) {
  for (std::size_t tip = 0; tip < works.size(); ++tip)
    if (!works[tip])
      warnings.push_back(
          fmt::format("tip {}: srif.richardson gives no error, because no method has room at twice the spacing; set "
                      "discretization.spacing = {:.2g}",
                      tip, spacing / 2));
}

/// The factors of every load case and combination.
std::vector<std::vector<post::Srif>> factors_of(const post::Summary& summary) {
  std::vector<std::vector<post::Srif>> rows;
  for (const auto& one : summary.load_cases) rows.push_back(one.srif);
  return rows;
}

}  // namespace

std::vector<std::vector<post::Srif>> coarser_factors(const CaseFile& file, const RunOptions& options,
                                                     std::vector<std::string>& warnings) {
  CaseFile coarse = file;
  Case& c = coarse.content;
  c.discretization = widened(c.discretization, 2);
  c.srif->richardson = c.srif->second_formulation = false;
  c.output.vtk = c.output.hdf5 = c.output.errors = false, c.output.probes.clear();
  std::vector<std::vector<post::Srif>> rows;
  std::vector<bool> works;
  if (!c.load_cases.empty() || c.faces_touch()) {
    post::ResultsInMemory unused;
    const Prepared prepared(std::move(coarse), *options.communicator);
    try {
      rows = factors_of_run(prepared, {{}, true, &unused, false, options.communicator});
    } catch (const plate::NumericalError& error) {
      throw plate::NumericalError(fmt::format("with twice the spacing: {}", error.what()));
    }
    for (const auto& tip : prepared.tip_methods) works.push_back(tip.works());
  } else {
    const auto found = discretised(coarse, *options.communicator);
    const auto methods = tip_methods(coarse, *found.plate);
    rows.push_back(fracture::of_all(
        *found.plate, factors_at_rest(*found.plate, methods, c.analysis, *c.srif, "with twice the spacing").factors));
    if (const auto& membrane = found.membrane)
      post::add_membrane(rows.back(),
                         factors_at_rest(*membrane, tip_methods(coarse, *membrane), c.analysis, *c.srif,
                                         "in the plane with twice the spacing")
                             .factors,
                         c.section);
    for (const auto& tip : methods) works.push_back(tip.works());
  }
  for (const auto& row : rows) post::require_finite(row, "with twice the spacing");
  warn_of_small_room(works, file.content.discretization.spacing, warnings);
  return rows;
}

namespace {

/// Results of a case without factors and files; absent where a hole, a ligament or a formula cannot have these points.
std::optional<post::Summary> results_of(const std::function<CaseFile()>& changed, const RunOptions& options) {
  post::ResultsInMemory unused;
  try {
    CaseFile file = changed();
    auto& c = file.content;
    c.srif.reset();
    c.output.vtk = c.output.hdf5 = c.output.errors = false, c.output.report = false;
    const Prepared prepared(std::move(file), *options.communicator);
    const RunPlan plan{prepared.file.content, {{}, true, &unused, false, options.communicator}};
    plate::Stopwatch stopwatch = prepared.stopwatch;
    Outputs outputs(plan, recording(plan).recorder, stopwatch);
    return run(prepared, outputs);
  } catch (const CaseError&) {
    return std::nullopt;
  } catch (const plate::NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<post::OtherResults> other_results(const CaseFile& file, const RunOptions& options,
                                                std::vector<std::string>& warnings) {
  // on errors that fall with the spacing; of bonds, whose errors are larger than those of the Galerkin plate
  constexpr double margin = 1.3, of_bonds = 1.5;
  const auto coarser = [&](double ratio) {
    CaseFile result = file;
    result.content.discretization = widened(file.content.discretization, ratio);
    return result;
  };
  if (file.content.discretization.formulation->offers(plate::Feature::horizon)) {
    // the error of bonds falls with the spacing, that of the Galerkin plate with its square
    constexpr double enough_points = 9000, least = 1.5, most = 2.5;
    const double points = geometry::area(file.content.outline) / std::pow(file.content.discretization.spacing, 2);
    const double ratio = std::clamp(std::sqrt(points / enough_points), least, most);
    if (auto found = results_of([&] { return in_other_formulation(coarser(ratio)); }, options))
      return post::OtherResults{std::move(*found), of_bonds, 3, 1};
  }
  for (const double ratio : {3.0, 2.0, 1.5})
    if (auto found = results_of([&] { return coarser(ratio); }, options))
      return post::OtherResults{std::move(*found), margin / (ratio - 1)};
  warnings.push_back(
      fmt::format("errors of results are not known, as these need a plate of fewer points; set "
                  "discretization.spacing = {:.2g}",
                  file.content.discretization.spacing / 2));
  return std::nullopt;
}

std::vector<std::vector<post::Srif>> factors_of_run(const Prepared& prepared, const RunOptions& options) {
  const RunPlan plan{prepared.file.content, options};
  plate::Stopwatch stopwatch = prepared.stopwatch;
  Outputs outputs(plan, recording(plan).recorder, stopwatch);
  const auto summary = run(prepared, outputs);
  return summary.load_cases.empty() ? outputs.factors().rows() : factors_of(summary);
}

}  // namespace cases
