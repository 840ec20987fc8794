#include <fmt/format.h>
#include <fmt/ranges.h>
#include "cases/driver/discretised.hpp"
#include "cases/driver/foretell.hpp"
#include "cases/driver/results.hpp"
#include "cases/driver/second_formulation.hpp"
#include "cases/input/refused.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "fracture/runs/shared/foretold_processes.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulations.hpp"
#include "plate/model/free_memory.hpp"
#include "plate/model/numerical_error.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/stored_factors.hpp"
#include "post/files/summary.hpp"
#include "post/report/html/report.hpp"
#include "post/report/html/study_report.hpp"
#include "post/report/say.hpp"
#include "post/studies/fatigue.hpp"
#include "post/studies/neighbouring_cracks.hpp"
#include "post/studies/runs/read_summary.hpp"

namespace cases {
namespace {

constexpr double giga = 1e9;

/// What processes that share the plate take.
std::string of_processes(const CaseFile& file, const fracture::ForetoldRun& run, int count) {
  const auto plan = plan_of(file.content, {});
  const auto processes = unless_refused(file, [&] { return fracture::foretold_processes(file.content, count); });
  return fracture::to_text(run, plan) + fracture::to_text(processes, fracture::run_by_one(run, plan)) +
         fmt::format("files         {:.3g} GB\n(by runs of a sample of {} points, just now)\n", run.costs.files / giga,
                     run.sample_points);
}

/// The cost of a case whose discretisation is known.
std::string of_run(const CaseFile& file, int processes) {
  const auto run = foretell(file);
  if (processes > 0) return of_processes(file, run, processes);
  std::string text = fracture::to_text(run, plan_of(file.content, {}));
  double bytes = run.bytes, seconds = run.costs.total();
  if (file.content.srif && file.content.srif->second_formulation) {
    const auto other = foretell(in_other_formulation(file));
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

/// What the run would refuse or warn of, where the plate is small enough to be made at once.
std::string of_plate(const CaseFile& file) {
  auto [plate, warnings, stopwatch] = discretised(file);
  check_growing_tips(file, *plate, warnings);
  tip_methods(file, *plate);
  std::string text =
      fmt::format("tips          {}\nfictitious    {} points, {} bonds to them\n{}", plate->tips().size(),
                  plate->fictitious_points(), plate->fictitious_bonds(), plate->of_edges());
  for (const auto& warning : warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace

std::string cost(const CaseFile& file, int processes) {
  constexpr double soon_made = 60000;  // points: 0.2 s
  const Case& c = file.content;
  if (processes > 0) require_shared(file, fracture::not_for_processes(plan_of(c, {})));
  std::string text = fmt::format("{}\nformulation   {} ({})\n", c.title, plate::formulation_of(c.discretization).name,
                                 c.formulation_reason);
  if (c.srif && c.srif->accuracy)
    return text +
           fmt::format(
               "srif.accuracy finds the discretisation: in {:g} s (accuracy_seconds) at most, with half of the free "
               "memory, {:.3g} GB, at most; the first points of the search have\n",
               c.srif->accuracy_seconds, plate::free_memory() / 2 / giga) +
           of_plate(file);
  if (processes == 0) require_memory(file);
  const double spacing = c.discretization.spacing;
  const bool made = geometry::area(c.outline) < soon_made * spacing * spacing;
  text += of_run(file, processes);
  text += made ? of_plate(file) : "tips, supports and loads are checked by the run: with so many points not here\n";
  return text;
}

post::Table energy_check(const CaseFile& file) {
  const Case& c = file.content;
  if (c.analysis.kind != Analysis::Kind::static_ || !c.load_cases.empty())
    throw CaseError(
        {{file.place("analysis.kind"), "analysis.kind", "the energy check needs a static case, of one load"}});
  return unless_refused(file, [&] { return post::energy_check(c, c.analysis); });
}

/// Says what of the growth is uncertain: its cycles are so too.
void say_doubts_of_growth(const std::filesystem::path& folder) {
  const auto summary = post::read_summary(folder / "summary.json");
  if (!summary || !summary->growth) return;
  if (summary->growth->outcome.find("not resolved") != std::string::npos)
    post::say(fmt::format("warning: the growth ended before its cracks did: {}\n", summary->growth->outcome));
  for (const auto& warning : summary->warnings)
    if (warning.starts_with("load factors are uncertain") || warning.starts_with("directions of tips"))
      post::say(fmt::format("warning: {}\n", warning));
}

post::Table fatigue(const std::filesystem::path& folder, const post::ParisLaw& law, double load, double ratio) {
  const CaseFile file = read_case(folder / "case.resolved.toml", {});
  const Case& c = file.content;
  if (!c.growth || c.analysis.kind != Analysis::Kind::static_ || c.growth->by_bonds())
    throw CaseError({{file.place("growth"), "growth",
                      "cycles are counted along tips that grow quasi-statically: a static case with [growth] and "
                      "criterion = \"energy_release\""}});
  say_doubts_of_growth(folder);
  try {
    return post::fatigue(post::read_csv(folder / "growth.csv"), post::read_csv(folder / "tips.csv"), c.section, law,
                         load, ratio);
  } catch (const plate::NumericalError&) {
    throw;
  } catch (const std::exception& error) {  // it reads and sums what the argument names, and does nothing else
    throw CaseError({{"fatigue", folder.string(), error.what()}});
  }
}

void report_again(const std::filesystem::path& folder) {
  if (post::write_report_of_many(folder)) return;
  if (!std::filesystem::exists(folder / "summary.json"))
    throw CaseError({{"report", folder.string(),
                      "holds no summary.json: name the folder of a finished run, study or table of extremes"}});
  if (!post::read_summary(folder / "summary.json"))
    throw CaseError(
        {{"report", (folder / "summary.json").string(), "is damaged, or of another version: run the case again"}});
  const Case c = read_case(folder / "case.resolved.toml", {}).content;
  post::write_report(folder, {c, c.title, c.source, c.units, c.output.probes});
}

post::Table srif_again(const std::filesystem::path& folder, const std::vector<std::string>& methods) {
  std::vector<std::string> overrides;
  if (!methods.empty()) overrides.push_back(fmt::format("srif.methods=[\"{}\"]", fmt::join(methods, "\", \"")));
  const CaseFile file = read_case(folder / "case.resolved.toml", overrides);
  const Case& c = file.content;
  if (c.growth)
    throw CaseError({{file.place("growth"), "growth",
                      "the cracks have grown since: srif.csv of the run has their factors "
                      "along the way"}});
  if (!c.srif) throw CaseError({{file.place("srif"), "srif", "is not there: this run finds no intensity factors"}});
  const auto run = post::read_run(folder / "state.h5");
  const auto own = discretised(file);
  const auto methods_of_tips = tip_methods(file, *own.plate);
  return post::stored_factors(run, *own.plate, *c.srif, methods_of_tips);
}

}  // namespace cases
