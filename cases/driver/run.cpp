#include "cases/driver/run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "cases/driver/accuracy.hpp"
#include "cases/driver/discretised.hpp"
#include "cases/driver/growth_run.hpp"
#include "cases/driver/lanczos.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/results.hpp"
#include "cases/driver/second_formulation.hpp"
#include "cases/driver/static_solution.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/formulations.hpp"
#include "cases/report/scene.hpp"
#include "fracture/growth/motion/moving_growth.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "post/factors/plate_factors.hpp"
#include "post/files/gate.hpp"
#include "post/report/progress.hpp"

namespace cases {
namespace {

/// The equilibrium under the loads of time 0.
plate::State start_of(const Case& c, const plate::Formulation& plate) {
  const auto load = plate.first_load();
  if (load.isZero(0)) return {};
  const auto result = plate::solve_static(plate, load, c.analysis.static_method(), c.analysis.preconditioner,
                                          {plate::StaticOptions{}.tolerance, c.analysis.max_iterations, {}});
  if (!result.solution.converged)
    throw plate::NumericalError(fmt::format("the plate at the start: {}, residual {:.2e}", result.solution.stop_reason,
                                            result.solution.residual));
  return result.solution.state;
}

/// The intensity factors of the case with twice the spacing.
std::vector<post::Srif> coarser_srifs(const CaseFile& file, std::vector<std::string>& warnings) {
  CaseFile coarse = file;
  Case& c = coarse.content;
  c.discretization.spacing *= 2;
  const auto found = discretised(coarse);
  const auto methods = tip_methods(coarse, *found.plate);
  const auto result = static_solution(c, *found.plate, {c.analysis.tolerance, c.analysis.max_iterations, {}});
  if (!result.solution.converged)
    throw plate::NumericalError(fmt::format("with twice the spacing: {}, residual {:.2e}", result.solution.stop_reason,
                                            result.solution.residual));
  auto factors = post::srifs(*found.plate, *c.srif, methods, result.solution.state);
  post::require_finite(factors, "with twice the spacing");
  for (std::size_t tip = 0; tip < methods.size(); ++tip)
    if (!methods[tip].works())
      warnings.push_back(fmt::format(
          "tip {}: srif.richardson knows nothing of its errors: no method has room with twice the spacing", tip));
  return factors;
}

void solve_static(const Prepared& prepared, Results& results, post::Summary& summary, bool quiet,
                  plate::Stopwatch& stopwatch) {
  const Case& c = prepared.file.content;
  const plate::Formulation& plate = *prepared.plate;
  using enum Analysis::Method;
  const auto method = c.analysis.method;
  post::Progress progress(quiet, method == adr      ? "adaptive dynamic relaxation"
                                 : method == direct ? "factorisation"
                                                    : "conjugate gradients");
  const plate::StaticOptions options{c.analysis.tolerance, c.analysis.max_iterations,
                                     [&](std::size_t i, double residual) {
                                       progress.update(std::log(residual) / std::log(c.analysis.tolerance),
                                                       fmt::format("iteration {}, residual {:.1e}", i, residual));
                                     }};
  const auto result = prepared.solution ? *prepared.solution : static_solution(c, plate, options);
  const auto& solution = result.solution;
  progress.done();
  stopwatch.lap("solve");

  summary.analysis.preconditioner = result.preconditioner;
  if (result.factor_bytes > 0)
    summary.scene.push_back({"factor", "", double(result.factor_bytes) / double(plate.cloud().plate_points), 0});
  post::describe(summary.analysis, result.method, solution, c.analysis.tolerance);
  post::require_finite(solution.state, "in equilibrium");
  const double work = post::slow_work(plate, solution.state);
  const double strain = plate.strain_energy(solution.state);
  const plate::Instant end{solution.iterations, 0, solution.state, {}, 0, work, strain, -2 * work};
  results.sample(end, true);
  stopwatch.lap("srif");
  results.frame(end);
  summary.energy = {{"strain", results.strain_energy()}, {"external_work", end.external_work}};
  if (!post::moves(solution.state, work))
    post::require_motion(plate, {plate.total_load()}, solution.state, work, summary.warnings);
  if (!solution.converged)
    throw plate::NumericalError(fmt::format("{}: {}, residual {:.2e} above tolerance {:.1e}", summary.analysis.method,
                                            solution.stop_reason, solution.residual, c.analysis.tolerance));
}

/// Takes the rows and frames of a motion, as far as the step `last`.
std::function<void(const plate::Instant&)> observer(const Prepared& prepared, std::size_t last, Results& results,
                                                    post::Summary& summary, post::Progress& progress,
                                                    plate::Stopwatch& stopwatch) {
  const Case& c = prepared.file.content;
  return [&, last, between = c.analysis.duration / double(last), next_frame = 0.0](const plate::Instant& now) mutable {
    stopwatch.lap("solve");
    progress.update(now.time / c.analysis.duration, fmt::format("t = {:.4g}", now.time));
    const bool is_last = now.step == last;
    results.sample(now, is_last);
    stopwatch.lap("srif");
    if (is_last || now.time >= next_frame - between / 2) {
      results.frame(now);
      next_frame = c.output.every ? next_frame + *c.output.every : INFINITY;
    }
    stopwatch.lap("output");
    summary.analysis.steps = now.step;
    summary.energy = {
        {"strain", results.strain_energy()}, {"kinetic", now.kinetic_energy}, {"external_work", now.external_work}};
    if (is_last && !post::moves(now.state, now.external_work))
      post::require_motion(*prepared.plate, post::forces_of(*prepared.plate), now.state, now.external_work,
                           summary.warnings);
  };
}

void solve_by_lanczos(const Prepared& prepared, Results& results, post::Summary& summary, bool quiet,
                      plate::Stopwatch& stopwatch) {
  const Case& c = prepared.file.content;
  const auto rows = prepared.steps->grid.steps;
  summary.analysis.method = "lanczos";
  summary.analysis.duration = c.analysis.duration;
  summary.analysis.tolerance = c.analysis.tolerance;
  post::Progress progress(quiet, "Lanczos vectors");
  const auto found = [&](std::size_t vectors, double change) {
    progress.update(std::min(0.9, double(vectors) / 100), fmt::format("{} vectors, change {:.1e}", vectors, change));
  };
  std::optional<plate::LanczosMotion> own;
  if (!prepared.motion) {
    own = lanczos_motion(c, *prepared.plate, prepared.tip_methods, INFINITY, found);
    results.factors().truncated(own->truncated());
  }
  const auto& motion = own ? *own : *prepared.motion;
  motion.observe(rows, observer(prepared, rows, results, summary, progress, stopwatch));
  progress.done();
  summary.analysis.iterations = motion.vectors();
  summary.analysis.residual = motion.change();
  summary.analysis.stop_reason = fmt::format("end of the duration, {} Lanczos vectors", motion.vectors());
}

void solve_dynamic(const Prepared& prepared, fracture::MovingGrowth* growth, Results& results, post::Summary& summary,
                   bool quiet, plate::Stopwatch& stopwatch) {
  const Case& c = prepared.file.content;
  const plate::Formulation& plate = *prepared.plate;
  const auto& [limit, grid] = *prepared.steps;
  const auto& constraints = plate.constraints();
  summary.analysis.method = "central_difference";
  summary.analysis.time_step = grid.time_step;
  summary.analysis.time_step_limit = limit;
  summary.analysis.duration = c.analysis.duration;

  post::Progress progress(quiet, "central differences");
  plate::DynamicOptions options{grid.time_step, grid.steps, grid.steps_per_row, {}, nullptr, {}};
  if (c.analysis.start == Analysis::Start::equilibrium) options.start = start_of(c, plate);
  if (c.analysis.precision == Analysis::Precision::mixed) options.single = plate.single_precision();
  if (growth) options.changes = &growth->changes();
  options.held_forces = true;
  plate::central_differences(growth ? growth->plate() : plate, constraints, plate.mass(c.analysis.rotary_inertia),
                             plate.loads(), options,
                             observer(prepared, grid.steps, results, summary, progress, stopwatch));
  summary.analysis.stop_reason = "end of the duration";
}

void solve_frequencies(const Case& c, const plate::Formulation& plate, Results& results, post::Summary& summary,
                       bool quiet, plate::Stopwatch& stopwatch) {
  const auto [low, high] = geometry::bounding_box(c.outline);
  post::Progress progress(quiet, "Lanczos iteration");
  const double usual = 4 * double(c.analysis.modes) + 12;  // solutions; 35 for 6 modes of a rectangle
  std::unique_ptr<plate::Preconditioner> coarser;
  if (plate.offers(plate::Feature::levels) && plate.held())
    coarser = plate.preconditioner(plate::Preconditioning::levels).inverse;
  const plate::FrequencyOptions options{c.analysis.modes,
                                        c.analysis.tolerance,
                                        c.analysis.max_iterations,
                                        plate::shift_of(c.section, (high - low).maxCoeff()),
                                        coarser.get(),
                                        [&](std::size_t solution) {
                                          progress.update(std::min(double(solution) / usual, 0.99),
                                                          fmt::format("solution {}", solution + 1));
                                        }};
  summary.analysis.method = "lanczos";
  summary.analysis.tolerance = c.analysis.tolerance;
  const auto& constraints = plate.constraints();
  const auto mass = plate.mass(c.analysis.rotary_inertia);
  const auto solution = plate::frequencies(plate, constraints, mass, options);
  progress.done();
  stopwatch.lap("solve");

  summary.analysis.iterations = solution.iterations;
  summary.analysis.residual = 0;
  for (std::size_t i = 0; i < solution.modes.size(); ++i) {
    results.mode(i + 1, solution.modes[i]);
    summary.analysis.residual = std::max(*summary.analysis.residual, solution.modes[i].residual);
  }
  stopwatch.lap("output");
  summary.analysis.stop_reason = fmt::format("{} modes in {} solutions", solution.modes.size(), solution.solutions);
}

void solve(const Prepared& prepared, fracture::MovingGrowth* growth, Results& results, post::Summary& summary,
           bool quiet, plate::Stopwatch& stopwatch) {
  const Case& c = prepared.file.content;
  switch (c.analysis.kind) {
    case Analysis::Kind::static_:
      return solve_static(prepared, results, summary, quiet, stopwatch);
    case Analysis::Kind::dynamic:
      if (c.analysis.method == Analysis::Method::lanczos)
        return solve_by_lanczos(prepared, results, summary, quiet, stopwatch);
      return solve_dynamic(prepared, growth, results, summary, quiet, stopwatch);
    case Analysis::Kind::frequencies:
      return solve_frequencies(c, *prepared.plate, results, summary, quiet, stopwatch);
  }
}

using SrifRows = std::vector<std::vector<post::Srif>>;

post::Summary run(const Prepared& prepared, Results& results, const RunOptions& options, plate::Stopwatch& stopwatch) {
  post::Summary summary = about(prepared.file.content, *prepared.plate, prepared.warnings);
  std::unique_ptr<fracture::MovingGrowth> growth;
  if (const Case& c = prepared.file.content; c.growth) {
    growth = fracture::moving_growth(*c.growth, *prepared.plate, c.srif, c.analysis.rotary_inertia);
    results.grows(*growth);
  }
  try {
    solve(prepared, growth.get(), results, summary, options.quiet, stopwatch);
    summary.outcome = "done";
  } catch (const plate::NumericalError& error) {
    summary.outcome = fmt::format("failed: {}", error.what());
    summary.analysis.stop_reason = error.what();
    results.finish(summary, stopwatch);
    throw;
  }
  return results.finish(std::move(summary), stopwatch);
}

/// The whole run of a case in its other formulation.
SrifRows run_second(const Prepared& prepared, const RunOptions& options) {
  plate::Stopwatch stopwatch = prepared.stopwatch;
  Results results(prepared.file, *prepared.plate, prepared.tip_methods, options);
  run(prepared, results, options, stopwatch);
  return results.factors().rows();
}

post::Summary run_accurately(const CaseFile& file, const RunOptions& options) {
  auto [plate, found, rows] = to_accuracy(file, options.quiet);
  plate::Stopwatch stopwatch = plate->stopwatch;
  Results results(plate->file, *plate->plate, plate->tip_methods, options);
  results.factors().known(std::move(rows));
  results.found(std::move(found));
  stopwatch.lap("output");
  return run(*plate, results, options, stopwatch);
}

}  // namespace

post::Summary run(const CaseFile& file, const RunOptions& options) {
  check_folder(options.folder);
  const Case& c = file.content;
  if (c.growth && c.analysis.kind == Analysis::Kind::static_) return grow(file, options);
  if (c.srif && c.srif->accuracy) return run_accurately(file, options);
  Prepared prepared(file);
  plate::Stopwatch stopwatch = prepared.stopwatch;
  std::optional<Prepared> second;
  if (c.srif && c.srif->second_formulation) {
    second.emplace(in_other_formulation(file));
    stopwatch.lap("second_formulation");
  }
  Results results(prepared.file, *prepared.plate, prepared.tip_methods, options);
  stopwatch.lap("output");
  if (c.srif && c.srif->richardson)
    results.factors().coarser(coarser_srifs(file, prepared.warnings)), stopwatch.lap("srif");
  if (second) {
    const auto name = second->file.content.discretization.formulation->name;
    results.factors().second(name, run_second(*second, options.part(name)));
    second.reset();
    stopwatch.lap("second_formulation");
  }
  return run(prepared, results, options, stopwatch);
}

}  // namespace cases
