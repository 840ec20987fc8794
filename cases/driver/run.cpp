#include "cases/driver/run.hpp"
#include <fmt/format.h>
#include "cases/driver/accuracy.hpp"
#include "cases/driver/discretised.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/results.hpp"
#include "cases/driver/second_formulation.hpp"
#include "fracture/runs/load_cases_run.hpp"
#include "fracture/runs/quasi_static_run.hpp"
#include "fracture/runs/response/response_run.hpp"
#include "fracture/runs/run_once.hpp"
#include "fracture/runs/shared/among_ranks.hpp"
#include "fracture/runs/trial.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/gate.hpp"

namespace cases {
namespace {

/// The intensity factors of the case with twice the spacing.
std::vector<post::Srif> coarser_srifs(const CaseFile& file, std::vector<std::string>& warnings) {
  CaseFile coarse = file;
  const Case& c = coarse.content;
  coarse.content.discretization.spacing *= 2;
  const auto found = discretised(coarse);
  const auto methods = tip_methods(coarse, *found.plate);
  auto factors = fracture::of_all(
      fracture::factors_at_rest(*found.plate, methods, c.analysis, *c.srif, "with twice the spacing").factors);
  post::require_finite(factors, "with twice the spacing");
  for (std::size_t tip = 0; tip < methods.size(); ++tip)
    if (!methods[tip].works())
      warnings.push_back(fmt::format(
          "tip {}: srif.richardson knows nothing of its errors: no method has room with twice the spacing", tip));
  return factors;
}

fracture::Results results_of(const Prepared& prepared, const RunOptions& options, post::Recorder recorder) {
  return {plan_of(prepared.file.content, options), *prepared.plate, prepared.tip_methods, std::move(recorder)};
}

/// The whole run of a case in its other formulation: the factors of all rows.
std::vector<std::vector<post::Srif>> run_second(const Prepared& prepared, const RunOptions& options) {
  plate::Stopwatch stopwatch = prepared.stopwatch;
  auto results = results_of(prepared, options, recording_of(prepared.file.content, options).recorder);
  fracture::run_once(prepared, results, stopwatch);
  return results.factors().rows();
}

post::Summary run_accurately(const CaseFile& file, const RunOptions& options) {
  auto [plate, found, rows] = to_accuracy(file, options.quiet);
  plate::Stopwatch stopwatch = plate->stopwatch;
  auto results = results_of(*plate, options, recording_of(plate->file.content, options).recorder);
  results.factors().known(std::move(rows));
  results.found(std::move(found));
  stopwatch.lap("output");
  return fracture::run_once(*plate, results, stopwatch);
}

/// The plate as it has grown quasi-statically, a hundredth above the load that is there, and what it does then.
CaseFile in_motion(CaseFile file, const fracture::QuasiStaticRun& run) {
  Case& c = file.content;
  c.analysis.kind = Analysis::Kind::dynamic;
  c.analysis.method = Analysis::Method::central_difference;
  c.analysis.start = Analysis::Start::equilibrium;
  c.analysis.duration = c.growth->duration;
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
  if (!c.growth->by_bonds()) with_factors.content.srif = fracture::factors_of_growth(c.srif);
  auto found = discretised(with_factors);
  check_growing_tips(file, *found.plate, found.warnings);
  tip_methods(with_factors, *found.plate);  // for what they refuse
  fracture::QuasiStaticRun run(plan_of(c, options), std::move(found));
  auto [recorder, keeper] = recording_of(c, options);
  const plate::StopOnSignals signals;
  auto summary = run(std::move(recorder), keeper.get());
  if (run.grown().ended.how == fracture::End::unstable && c.growth->unstable == fracture::Growth::Unstable::move)
    cases::run(in_motion(file, run), options.part("motion"));
  if (keeper) keeper->done();
  return summary;
}

post::Summary run_in_folder(const CaseFile& file, const RunOptions& options) {
  if (!options.kept) fracture::check_folder(options.folder);
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
  auto [recorder, keeper] = recording_of(prepared.file.content, options);
  if (!c.load_cases.empty())
    return fracture::run_load_cases(prepared, plan_of(c, options), std::move(recorder), stopwatch);
  if (c.analysis.kind == Analysis::Kind::harmonic)
    return fracture::run_response(prepared, plan_of(c, options), std::move(recorder), stopwatch);
  auto results = results_of(prepared, options, std::move(recorder));
  const plate::StopOnSignals signals;
  stopwatch.lap("output");
  if (c.srif && c.srif->richardson)
    results.factors().coarser(coarser_srifs(file, prepared.warnings)), stopwatch.lap("srif");
  if (second) {
    const auto name = second->file.content.discretization.formulation->name;
    auto part = options.part(name);
    part.resume = false;
    results.factors().second(name, run_second(*second, part));
    second.reset();
    stopwatch.lap("second_formulation");
  }
  auto summary = fracture::run_once(prepared, results, stopwatch, keeper.get());
  if (keeper) keeper->done();
  return summary;
}

}  // namespace

post::Summary run(const CaseFile& file, const RunOptions& options) {
  const Case& c = file.content;
  require_shared(file, fracture::unshared(plan_of(c, options)));
  if (options.resume && !(c.growth && c.growth->unstable == fracture::Growth::Unstable::move))
    if (auto done = fracture::done_before(recording_options(c, options), c.output.reports())) return std::move(*done);
  try {
    return run_in_folder(file, options);
  } catch (const fracture::RefusedFolder& refused) {
    const bool writes = refused.wish() == fracture::RefusedFolder::Wish::write;
    throw CaseError({{writes ? "--out" : "--resume", options.folder.string(), refused.what()}});
  }
}

}  // namespace cases
