#include <fmt/format.h>

#include "cases/runs/analyses.hpp"
#include "cases/runs/results.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/buckling.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

/// Table of the steps of the load.
post::Table table_of(const std::vector<plate::LoadStep>& steps) {
  post::Table table{{"factor", "iterations", "residual", "largest_deflection", "strain_energy", "stable", "snapped"},
                    {}};
  for (const auto& step : steps)
    table.rows.push_back({step.factor, double(step.iterations), step.residual, step.largest_deflection,
                          step.strain_energy, step.stable ? "yes" : "no", step.snapped ? "yes" : "no"});
  return table;
}

/// Equilibrium of a plate whose middle plane stretches.
class LargeDeflectionRun : public PlateAnalysis {
public:
  LargeDeflectionRun(const ValidatedPlate& ready, Outputs& outputs)
      : PlateAnalysis(ready, outputs), results_(outputs, plate_, ready.tip_methods) {}

  void solve() override;
  void finish() override;

private:
  MembraneResult in_plane(const plate::LargeDeflections& found) const;
  void warn(const plate::LargeDeflections& found);

  Results results_;
};

/// Results in the plane, with the strains that the deflections add.
MembraneResult LargeDeflectionRun::in_plane(const plate::LargeDeflections& found) const {
  const auto& membrane = *ready_.membrane;
  auto result = membrane_results(membrane, found.membrane, membrane.total_load() + found.stretch.forces,
                                 {content().srif, ready_.membrane_methods}, "in the plane", &found.stretch);
  result.forces.moments = result.fields.force = found.membrane_forces;
  result.summary.strain_energy = found.membrane_energy;
  result.summary.external_work = found.external_work;
  result.summary.residual = found.steps.empty() ? 0 : found.steps.back().residual;
  return result;
}

void LargeDeflectionRun::warn(const plate::LargeDeflections& found) {
  constexpr double coarse = 0.05;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < found.steps.size(); ++i) {
    const auto& step = found.steps[i];
    const double before = i == 0 ? 0 : found.steps[i - 1].factor;
    if (step.snapped)
      lines.push_back(fmt::format("the plate snaps between load factors {:.4g} and {:.4g}: see load_steps.csv", before,
                                  step.factor));
  }
  if (!found.steps.empty() && !found.steps.back().stable)
    lines.emplace_back("the equilibrium is not stable: give the plate a small load across it");
  const double strain = found.bending_energy + found.membrane_energy,
               apart = std::abs(found.external_work / strain - 1);
  if (strain > 0 && !found.snapped() && apart > coarse)
    lines.push_back(
        fmt::format("strain energy and work of the loads differ by {:.2g} %: the state may not be the one "
                    "that grows with the loads; see load_steps.csv",
                    100 * apart));
  outputs_.warn(std::move(lines));
  outputs_.warn(warnings_about_rotations(found.bending.bottomRows(2).colwise().norm().maxCoeff()));
}

void LargeDeflectionRun::solve() {
  const auto& analysis = content().analysis;
  auto& summary = this->summary();
  post::Progress progress(quiet(), "large deflections");
  const plate::LargeDeflectionOptions options{
      analysis.tolerance, [&](double factor, std::size_t iteration, double residual) {
        progress.update(factor,
                        fmt::format("load factor {:.3g}, iteration {}, residual {:.1e}", factor, iteration, residual));
      }};
  const auto found = plate::StretchedPlate(plate_, *ready_.membrane).equilibrium(options);
  progress.done();
  stopwatch().lap("solve");

  auto& about = summary.analysis;
  about.method = "newton", about.iterations = found.iterations, about.tolerance = analysis.tolerance;
  about.residual = found.steps.empty() ? 0 : found.steps.back().residual, about.stop_reason = found.stop_reason;
  summary.load_steps = table_of(found.steps);
  summary.scene.push_back({"factor", "", double(found.factor_bytes) / double(plate_.cloud().plate_points), 0});
  const double strain = found.bending_energy + found.membrane_energy;
  plate::Instant end{found.iterations, 0, found.bending, {}, 0, found.external_work, strain, 0, 0};
  end.stretched = &found.on_bending;
  results_.in_plane(*ready_.membrane, in_plane(found));
  results_.sample(end, true);
  stopwatch().lap("srif");
  results_.frame(end);
  summary.energy = {{"strain", strain},
                    {"bending", found.bending_energy},
                    {"stretching", found.membrane_energy},
                    {"external_work", found.external_work}};
  if (strain == 0)
    post::require_motion(plate_, post::forces_of(plate_), found.bending, found.external_work, summary.warnings);
  warn(found);
  if (!found.converged) throw plate::NumericalError("large deflections: " + found.stop_reason);
}

void LargeDeflectionRun::finish() {
  outputs_.recorder().table("load_steps", summary().load_steps);
  results_.finish();
}

/// Buckling loads and shapes of a flat plate.
class BucklingRun : public PlateAnalysis {
public:
  BucklingRun(const ValidatedPlate& ready, Outputs& outputs)
      : PlateAnalysis(ready, outputs), results_(outputs, plate_, ready.tip_methods) {}

  void solve() override;
  void finish() override;

private:
  Results results_;
};

void BucklingRun::solve() {
  const auto& analysis = content().analysis;
  auto& summary = this->summary();
  post::Progress progress(quiet(), "buckling");
  outputs_.warn(warnings_about_pressed_faces(*ready_.membrane, analysis));
  const std::optional<post::SrifOptions> no_factors;
  auto at_rest = membrane_at_rest(*ready_.membrane, analysis, {no_factors, ready_.membrane_methods});
  summary.membrane = at_rest.summary;
  outputs_.warn(std::move(at_rest.warnings));
  const auto found = plate::buckling(plate_, plate::prestress(*ready_.membrane), analysis.modes, analysis.tolerance);
  progress.done();
  stopwatch().lap("solve");
  summary.analysis.method = "lanczos";
  summary.analysis.tolerance = analysis.tolerance;
  summary.analysis.residual = 0;
  for (const auto& mode : found) {
    const auto number = summary.buckling.size() + 1;
    post::require_finite(mode.shape, fmt::format("of buckling mode {}", number), plate_);
    summary.buckling.push_back({number, mode.factor, mode.residual, {}});
    summary.analysis.residual = std::max(*summary.analysis.residual, mode.residual);
    results_.frame({number, double(number), mode.shape, {}, 0, 0, 0, 0});
  }
  stopwatch().lap("output");
  summary.analysis.stop_reason = fmt::format("{} modes", found.size());
  if (found.size() < analysis.modes)
    outputs_.warn(
        {fmt::format("the loads make the plate buckle in {} modes only: most of it is in tension", found.size())});
}

void BucklingRun::finish() {
  post::Table table{{"mode", "factor", "residual", "estimated_error"}, {}};
  for (const auto& one : summary().buckling)
    table.rows.push_back(
        {double(one.mode), one.factor, one.residual, one.error ? post::Cell(*one.error) : post::Cell()});
  outputs_.recorder().table("buckling", std::move(table));
  results_.finish();
}

}  // namespace

std::unique_ptr<PlateAnalysis> large_deflections(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<LargeDeflectionRun>(ready, outputs);
}

std::unique_ptr<PlateAnalysis> buckling(const ValidatedPlate& ready, Outputs& outputs) {
  return std::make_unique<BucklingRun>(ready, outputs);
}

}  // namespace cases
