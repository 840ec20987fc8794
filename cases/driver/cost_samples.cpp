#include "cases/driver/cost_samples.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <ctime>

#include "cases/driver/prepared.hpp"
#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/formulations.hpp"
#include "cases/input/keys.hpp"
#include "cases/runs/distributed_run.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulations.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/process.hpp"
#include "post/files/run_folder.hpp"

namespace cases {
namespace {

using plate::EdgeMethod;

/// The second half of a path.
geometry::Polyline second_half(const geometry::Polyline& path) {
  double rest = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) rest += (path[i + 1] - path[i]).norm() / 2;
  std::size_t i = 0;
  for (; i + 2 < path.size() && rest > (path[i + 1] - path[i]).norm(); ++i) rest -= (path[i + 1] - path[i]).norm();
  geometry::Polyline result{path[i] + rest * (path[i + 1] - path[i]).normalized()};
  result.insert(result.end(), path.begin() + std::ptrdiff_t(i + 1), path.end());
  return result;
}

/// Lets a load that moves begin in the middle of its path: where it begins it may stand beside the plate.
void begin_in_the_middle(plate::Load& load) {
  if (!load.moves()) return;
  const auto path = second_half(load.path());
  const geometry::Point way = path.front() - load.path().front();
  if (auto* force = std::get_if<plate::PointForce>(&load.action)) force->path = path, force->position += way;
  if (auto* pressure = std::get_if<plate::Pressure>(&load.action)) {
    pressure->path = path;
    if (pressure->patch) *pressure->patch = geometry::moved(*pressure->patch, way);
  }
}

CaseFile sample_of(const CaseFile& file, const plate::UsualSolver& solver, const ReducedRun& reduced) {
  CaseFile result = file;
  Case& c = result.content;
  c.discretization = widened(c.discretization, reduced.wider);
  if (const auto edges = c.discretization.boundary; edges != EdgeMethod::images && edges != EdgeMethod::layer)
    c.section.thicken(reduced.wider);  // they ask for points that are close for it
  c.analysis = sampled(c.analysis, solver, reduced, c.growth.has_value());
  for (auto& load : c.loads) {
    load.history = {};  // some start from nothing, and nothing would move
    begin_in_the_middle(load);
    if (load.as<plate::Settlement>() && c.analysis.kind == Analysis::Kind::dynamic)
      load.history.kind = plate::History::Kind::ramp, load.history.rise_time = c.analysis.duration;  // none jumps
  }
  for (auto& soil : c.foundations) soil.unilateral = false;  // few and wide points may tip where the plate does not
  for (auto& support : c.supports) support.push = plate::Push::both_ways;
  c.output.history_every = c.analysis.duration / std::clamp(reduced.steps / 8, 1.0, 8.0);
  c.output.every.reset(), c.output.probes.clear(), c.output.lines.clear(), c.output.errors = false;
  c.output.edge_reactions = 0;
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
  auto result = sample_run(sample.content, run(sample, {scratch.path(), true}), reduced.wider);
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

RunEstimate estimate_cost(const CaseFile& file) {
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
  return unless_refused(file, [&] { return estimate_cost(file.content, run); });
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

namespace {

constexpr double giga = 1e9;

/// Estimated cost, as text, of a run by `count` ranks of a distributed plate.
std::string of_processes(const CaseFile& file, const RunEstimate& run, int count) {
  const Case& c = file.content;
  const auto processes = unless_refused(file, [&] { return estimated_processes(c, count); });
  return to_text(run, c) + to_text(processes, run_by_one(run, c)) +
         fmt::format("files         {:.3g} GB\n(by runs of a sample of {} points, just now)\n", run.costs.files / giga,
                     run.sample_points);
}

/// The cost of a case whose discretisation is known.
std::string of_run(const CaseFile& file, int processes) {
  const auto run = estimate_cost(file);
  if (processes > 0) return of_processes(file, run, processes);
  std::string text = to_text(run, file.content);
  double bytes = run.bytes, seconds = run.costs.total();
  if (file.content.srif && file.content.srif->second_formulation) {
    const auto other = estimate_cost(in_other_formulation(file));
    bytes += other.bytes, seconds += other.costs.total();
    text += fmt::format("both ways     {:.2g} s\n", seconds);
  }
  text += cheaper_way(file, seconds);
  const double free = plate::free_memory();
  text += fmt::format("memory        {:.3g} GB at its peak; {:.3g} GB are free\nfiles         {:.3g} GB\n",
                      bytes / giga, free / giga, run.costs.files / giga);
  text += fmt::format("(by runs of a sample of {} points, just now)\n", run.sample_points);
  if (free > 0 && bytes > free)
    throw CaseError({{file.place("discretization.spacing"), "discretization.spacing",
                      fmt::format("{:g} given makes {:.2g} points, which take {:.3g} GB, more than this machine has: "
                                  "{:.3g} GB are free",
                                  file.content.discretization.spacing, run.points, bytes / giga, free / giga)}});
  return text;
}

/// Describes the plate, with the warnings and refusals of the run, where the plate is small enough to be made at once.
std::string of_plate(const CaseFile& file) {
  auto [plate, membrane, warnings, stopwatch] = discretised(file);
  check_growing_tips(file, *plate, warnings);
  tip_methods(file, *plate);
  std::string text =
      fmt::format("tips          {}\nfictitious    {} points, {} bonds to them\n{}", plate->tips().size(),
                  plate->fictitious_points(), plate->fictitious_bonds(), plate->of_edges());
  for (const auto& warning : warnings) text += "warning: " + with_keys(warning) + "\n";
  return text;
}

}  // namespace

std::string cost(const CaseFile& file, int processes) {
  constexpr double soon_made = 60000;  // points: 0.2 s
  const Case& c = file.content;
  if (processes > 0) require_distributable(file, processes);
  std::string text = fmt::format("{}\nformulation   {} ({})\n", c.title, plate::formulation_of(c.discretization).name,
                                 c.formulation_reason);
  if (c.finds_spacing())
    return text +
           fmt::format(
               "{} finds the discretisation: in {:g} s ({}) at most, with half of the free "
               "memory, {:.3g} GB, at most; the first points of the search have\n",
               c.accuracy ? "[accuracy]" : "srif.accuracy", c.accuracy ? c.accuracy->seconds : c.srif->accuracy_seconds,
               c.accuracy ? "accuracy.seconds" : "accuracy_seconds", plate::free_memory() / 2 / giga) +
           of_plate(file);
  if (processes == 0) unless_refused(file, [&] { plate::require_memory(c); });
  const double spacing = c.discretization.spacing;
  const bool made = geometry::area(c.outline) < soon_made * spacing * spacing;
  text += of_run(file, processes);
  text += made ? of_plate(file) : "tips, supports and loads are checked by the run: with so many points not here\n";
  return text;
}

}  // namespace cases
