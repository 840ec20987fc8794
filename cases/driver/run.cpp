#include "cases/driver/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/driver/accuracy.hpp"
#include "cases/driver/fatigue.hpp"
#include "cases/driver/neighbouring_cracks.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/recording.hpp"
#include "cases/driver/targets.hpp"
#include "cases/input/case_file.hpp"
#include "cases/input/formulations.hpp"
#include "cases/runs/analyses.hpp"
#include "cases/runs/distributed_run.hpp"
#include "cases/runs/outputs.hpp"
#include "cases/runs/quasi_static_run.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/factor_rows.hpp"
#include "post/files/hdf5/state_file.hpp"
#include "post/files/summary.hpp"
#include "post/report/html_report.hpp"
#include "post/report/quantity.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

void look_at_errors(Prepared& prepared, const RunOptions& options) {
  if (!prepared.file.content.wants_errors()) return;
  if (auto other = other_results(prepared.file, options, prepared.warnings))
    prepared.other_results.push_back(std::move(*other));
  prepared.stopwatch.lap("errors");
}

post::Summary run_accurately(const CaseFile& file, const RunOptions& options) {
  const bool of_results = file.content.accuracy.has_value();
  const auto prepared = of_results ? to_targets(file, options) : to_accuracy(file, options.quiet);
  if (!of_results) look_at_errors(*prepared, options);
  const RunPlan plan{prepared->file.content, options};
  Outputs outputs(plan, recording(plan).recorder, prepared->stopwatch);
  prepared->stopwatch.lap("output");
  return run(*prepared, outputs);
}

/// The plate as it has grown quasi-statically, a hundredth above the load that is there, and what it does then.
CaseFile in_motion(CaseFile file, const QuasiStaticRun& run) {
  Case& c = file.content;
  c.analysis.kind = Analysis::Kind::dynamic;
  c.analysis.method = Analysis::Method::central_difference;
  c.analysis.start = Analysis::Start::equilibrium;
  c.analysis.duration = c.growth->duration;
  c.joined_with_plane = plate::loaded_in_plane(c);
  c.growth->unstable = fracture::Growth::Unstable::jump;
  c.output.every = c.growth->duration / 10;
  c.cracks = run.cracks();
  const double factor = 1.01 * run.load_factor();
  for (auto& load : c.loads) plate::scale(load, factor), load.history = {};
  return file;
}

post::Summary grow(const CaseFile& file, const RunOptions& options) {
  const Case& c = file.content;
  CaseFile with_factors = file;
  if (!c.growth->by_bonds()) with_factors.content.srif = factors_of_growth(c.srif);
  auto found = discretised(with_factors, *options.communicator);
  check_growing_tips(file, *found.plate, found.warnings);
  tip_methods(with_factors, *found.plate);  // for what they refuse
  const RunPlan plan{c, options};
  QuasiStaticRun run(plan, std::move(found));
  auto [recorder, checkpoints] = recording(plan);
  const plate::StopOnSignals signals;
  auto summary = run(std::move(recorder), checkpoints.get());
  if (run.outcome().ended.how == fracture::End::unstable && c.growth->unstable == fracture::Growth::Unstable::move)
    cases::run(in_motion(file, run), options.part("motion"));
  if (checkpoints) checkpoints->done();
  return summary;
}

post::Summary run_in_folder(const CaseFile& file, const RunOptions& options) {
  if (!options.in_memory && options.communicator->rank() == 0) check_folder(options.folder);
  const Case& c = file.content;
  if (c.growth && c.analysis.kind == Analysis::Kind::static_) return grow(file, options);
  if (c.finds_spacing()) return run_accurately(file, options);
  Prepared prepared(file, *options.communicator);
  auto& stopwatch = prepared.stopwatch;
  std::optional<Prepared> second;
  if (c.srif && c.srif->second_formulation) {
    second.emplace(in_other_formulation(file));
    stopwatch.lap("second_formulation");
  }
  const RunPlan plan{prepared.file.content, options};
  auto [recorder, checkpoints] = recording(plan);
  Outputs outputs(plan, std::move(recorder), stopwatch);
  const plate::StopOnSignals signals;
  stopwatch.lap("output");
  auto& others = prepared.other_factors;
  if (c.srif && c.srif->richardson)
    others.coarser = coarser_factors(file, options, prepared.warnings), stopwatch.lap("srif");
  if (second) {
    others.formulation = second->file.content.discretization.formulation->name;
    others.closed = c.faces_touch();
    auto part = options.part(others.formulation);
    part.resume = false;
    others.second = factors_of_run(*second, part);
    second.reset();
    stopwatch.lap("second_formulation");
  }
  look_at_errors(prepared, options);
  auto summary = run(prepared, outputs, checkpoints.get());
  if (checkpoints) c.moves() ? checkpoints->keep_last() : checkpoints->done();
  return summary;
}

}  // namespace

post::Summary run(const CaseFile& given, const RunOptions& options) {
  const CaseFile file = going_on(given, options);
  const Case& c = file.content;
  if (const auto& all = *options.communicator; all.distributed()) require_distributable(file, all.size());
  if (options.resume && !(c.growth && c.growth->unstable == fracture::Growth::Unstable::move))
    if (auto done = done_before({c, options})) return std::move(*done);
  try {
    return run_in_folder(file, options);
  } catch (const RefusedFolder& refused) {
    const bool writes = refused.attempt() == RefusedFolder::Attempt::write;
    throw CaseError({{writes ? "--out" : "--resume", options.folder.string(), refused.what()}});
  } catch (const plate::NumericalError& failed) {
    throw plate::NumericalError(with_keys(failed.what()));
  }
}

post::Table energy_check(const CaseFile& file) {
  const Case& c = file.content;
  if (c.analysis.kind != Analysis::Kind::static_ || !c.load_cases.empty())
    throw CaseError(
        {{file.place("analysis.kind"), "analysis.kind", "the energy check needs a static case, of one load"}});
  if (c.analysis.nonlinear)
    throw CaseError({{file.place("analysis.nonlinear"), "analysis.nonlinear",
                      "the energy check solves linear plates: srif.csv of the run has the factors of this one"}});
  if (c.faces_touch())
    throw CaseError({{file.place("cracks.contact"), "cracks.contact",
                      "the energy check solves plates with open cracks: remove it"}});
  return unless_refused(file, [&] { return energy_check(c, c.analysis); });
}

/// Says what of the growth is uncertain: its cycles are so too.
void say_doubts_of_growth(const std::filesystem::path& folder) {
  const auto summary = post::read_summary(folder / "summary.json");
  if (!summary || !summary->growth) return;
  if (!summary->growth->resolved)
    post::say("warning: the growth stopped unresolved, and the cycles end there; see growth.outcome in summary.json\n");
  for (const auto& warning : summary->warnings)
    if (warning.starts_with("load factors are uncertain") || warning.starts_with("directions of tips"))
      post::say(fmt::format("warning: {}\n", warning));
}

post::Table fatigue(const std::filesystem::path& folder, const ParisLaw& law, double load, double ratio) {
  const CaseFile file = read_case(folder / "case.resolved.toml", {});
  const Case& c = file.content;
  if (!c.growth || c.analysis.kind != Analysis::Kind::static_ || c.growth->by_bonds())
    throw CaseError({{file.place("growth"), "growth",
                      "cycles are counted along tips that grow quasi-statically: a static case with [growth] and "
                      "criterion = \"energy_release\""}});
  if (plate::loaded_in_plane(c) || c.faces_touch())
    throw CaseError(
        {{file.place("growth"), "growth",
          "cycles are counted by the bending stress at the face, and membrane forces act here too: tips.csv "
          "has K1, K2, K3, N1 and N2 along the way"}});
  say_doubts_of_growth(folder);
  if (c.units == "SI") post::say("units: length in m, K_range in Pa m^1/2, coefficient in m / (Pa m^1/2)^exponent\n");
  try {
    return fatigue(post::read_csv(folder / "growth.csv"), post::read_csv(folder / "tips.csv"), c.section, law, load,
                   ratio);
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
  post::write_report(folder, reported(c));
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
  if (c.faces_touch())
    throw CaseError({{file.place("cracks.contact"), "cracks.contact",
                      "frames do not say where faces touch: srif.csv of the run has the factors"}});
  if (!c.srif) throw CaseError({{file.place("srif"), "srif", "is not there: this run finds no intensity factors"}});
  const auto run = post::read_run(folder / "state.h5");
  const auto own = discretised(file);
  const auto methods_of_tips = tip_methods(file, *own.plate);
  if (!own.membrane) return post::stored_factors(run, *own.plate, *c.srif, methods_of_tips);
  const auto methods_in_plane = tip_methods(file, *own.membrane);
  return post::stored_factors(run, *own.plate, *c.srif, methods_of_tips,
                              post::PlateInPlane{*own.membrane, methods_in_plane});
}

}  // namespace cases
