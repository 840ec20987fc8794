#include "cases/driver/run.hpp"

#include <fmt/format.h>

#include "cases/driver/accuracy.hpp"
#include "cases/driver/discretised.hpp"
#include "cases/driver/growth_run.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/driver/results.hpp"
#include "cases/driver/second_formulation.hpp"
#include "fracture/runs/run_once.hpp"
#include "fracture/runs/trial.hpp"
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
  auto factors =
      fracture::factors_at_rest(*found.plate, methods, c.analysis, *c.srif, "with twice the spacing").factors;
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
  auto results = results_of(prepared, options, std::move(recorder));
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
  try {
    return run_in_folder(file, options);
  } catch (const fracture::RefusedFolder& refused) {
    const bool writes = refused.wish() == fracture::RefusedFolder::Wish::write;
    throw CaseError({{writes ? "--out" : "--resume", options.folder.string(), refused.what()}});
  }
}

}  // namespace cases
