#include "cases/driver/cost_samples.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "cases/driver/case_plan.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/keys.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulations.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/numerical_method.hpp"
#include "post/files/run_folder.hpp"

namespace cases {
namespace {

using fracture::ReducedRun;
using plate::EdgeMethod;

CaseFile sample_of(const CaseFile& file, const plate::UsualSolver& solver, const ReducedRun& reduced) {
  CaseFile result = file;
  Case& c = result.content;
  c.discretization = fracture::widened(c.discretization, reduced.wider);
  if (const auto edges = c.discretization.boundary; edges != EdgeMethod::images && edges != EdgeMethod::layer)
    c.section.thicken(reduced.wider);  // they ask for points that are close for it
  c.analysis = fracture::sampled(c.analysis, solver, reduced, c.growth.has_value());
  for (auto& load : c.loads) {
    load.history = {};  // some start from nothing, and nothing would move
    if (load.as<plate::Settlement>() && c.analysis.kind == Analysis::Kind::dynamic)
      load.history.kind = plate::History::Kind::ramp, load.history.rise_time = c.analysis.duration;  // none jumps
  }
  for (auto& soil : c.foundations) soil.unilateral = false;  // few and wide points may tip where the plate does not
  c.output.history_every = c.analysis.duration / std::clamp(reduced.steps / 8, 1.0, 8.0);
  c.output.every.reset(), c.output.probes.clear();
  if (!reduced.factors) c.srif.reset();
  if (c.impact) c.impact->stiffness *= 1e-9;
  if (c.srif) c.srif->second_formulation = c.srif->richardson = false;
  if (c.growth) c.growth->max_advances = 1, c.growth->unstable = fracture::Growth::Unstable::jump;
  return result;
}

post::SampleRun run_of(const CaseFile& file, const plate::UsualSolver& solver, const ReducedRun& reduced) {
  const auto sample = sample_of(file, solver, reduced);
  const post::ScratchFolder scratch("pdplate_check");
  const auto begun = std::clock();
  plate::Stopwatch watch;
  auto result = fracture::sample_run(plan_of(sample.content, {}), run(sample, {scratch.path(), true}), reduced.wider);
  watch.lap("run");
  result.share = std::min(1.0, double(std::clock() - begun) / CLOCKS_PER_SEC / watch.total());
  result.files = scratch.bytes();
  return result;
}

/// Returns the same motion by the other method: by Lanczos vectors of the Galerkin plate instead of steps, or by steps.
/// Empty where its plate cannot be moved so.
std::optional<CaseFile> by_other_method(const CaseFile& file) {
  using enum Analysis::Method;
  CaseFile other = file;
  auto& analysis = other.content.analysis;
  auto& d = other.content.discretization;
  if (analysis.kind != Analysis::Kind::dynamic || other.content.growth) return {};
  analysis.method = analysis.method == lanczos ? central_difference : lanczos;
  analysis.time_step.reset();
  if (analysis.method == lanczos) analysis.precision = Analysis::Precision::double_;
  if (analysis.method == lanczos && !d.formulation->offers(plate::Feature::lanczos)) {
    const double spacing = d.spacing;
    d = {}, d.spacing = spacing;
    d.formulation = *std::ranges::find_if(plate::formulations(),
                                          [](const auto* one) { return one->offers(plate::Feature::lanczos); });
  }
  other.source.places = {{"analysis.method", "check"}};  // as if the case stated it
  Reading reading("");
  reading.found().places = other.source.places, reading.kind = analysis.kind;
  check_case(other.content, reading);
  return reading.problems().empty() ? std::optional(other) : std::nullopt;
}

}  // namespace

fracture::RunEstimate estimate_cost(const CaseFile& file) {
  const auto run = [&](const plate::UsualSolver& solver, const ReducedRun& reduced) -> std::optional<post::SampleRun> {
    try {
      return run_of(file, solver, reduced);
    } catch (const CaseError& error) {
      // no number of points helps an expression that has no value, or is noise
      const bool for_good = std::ranges::any_of(
          error.problems(), [](const Problem& problem) { return problem.key.ends_with("expression"); });
      if (reduced.wider == 1 || for_good) throw;
    } catch (const plate::NumericalError&) {
      if (reduced.wider == 1) throw;
    }
    return {};
  };
  return unless_refused(file, [&] { return fracture::estimate_cost(plan_of(file.content, {}), run); });
}

std::string cheaper_way(const CaseFile& file, double seconds) {
  constexpr double worth_it = 1, clearly = 0.7;  // s; as estimated times are no more exact
  if (!(seconds > worth_it)) return "";
  const auto other = by_other_method(file);
  if (!other) return "";
  try {
    const double others = estimate_cost(*other).costs.total();
    if (!(others < clearly * seconds)) return "";
    const bool same = other->content.discretization.formulation == file.content.discretization.formulation;
    const bool vectors = other->content.analysis.method == Analysis::Method::lanczos;
    return fmt::format("cheaper       {}analysis.method = \"{}\": {:.2g} s\n",
                       same ? "" : "discretization.formulation = \"galerkin\" with ",
                       vectors ? "lanczos" : "central_difference", others);
  } catch (const CaseError&) {  // it cannot be run
    return "";
  } catch (const plate::NumericalError&) {
    return "";
  }
}

}  // namespace cases
