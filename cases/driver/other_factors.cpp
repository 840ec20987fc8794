#include "cases/driver/other_factors.hpp"

#include <fmt/format.h>

#include "cases/driver/accuracy.hpp"
#include "cases/driver/case_plan.hpp"
#include "cases/driver/prepared.hpp"
#include "cases/runs/load_cases_run.hpp"
#include "cases/runs/results.hpp"
#include "cases/runs/run_once.hpp"
#include "fracture/growth/distributed_growth.hpp"
#include "plate/model/errors.hpp"
#include "post/files/result_checks.hpp"
#include "post/files/results_in_memory.hpp"

namespace cases {
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

std::vector<std::vector<post::Srif>> coarser_factors(const CaseFile& file, const RunOptions& of_run,
                                                     std::vector<std::string>& warnings) {
  CaseFile coarse = file;
  Case& c = coarse.content;
  c.discretization.spacing *= 2, c.srif->richardson = c.srif->second_formulation = false;
  c.output.vtk = c.output.hdf5 = false, c.output.probes.clear();
  std::vector<std::vector<post::Srif>> rows;
  std::vector<bool> works;
  if (!c.load_cases.empty()) {
    post::ResultsInMemory unused;
    Prepared prepared(std::move(coarse), *of_run.communicator);
    plate::Stopwatch stopwatch;
    const RunOptions options{{}, true, &unused, false, of_run.communicator};
    Outputs outputs(plan_of(prepared.file.content, options), recording_of(prepared.file.content, options).recorder,
                    stopwatch);
    try {
      rows = factors_of(run_load_cases(prepared, outputs));
    } catch (const plate::NumericalError& error) {
      throw plate::NumericalError(fmt::format("with twice the spacing: {}", error.what()));
    }
    for (const auto& tip : prepared.tip_methods) works.push_back(tip.works());
  } else {
    const auto found = discretised(coarse, *of_run.communicator);
    const auto methods = tip_methods(coarse, *found.plate);
    rows.push_back(fracture::of_all(
        *found.plate, factors_at_rest(*found.plate, methods, c.analysis, *c.srif, "with twice the spacing").factors));
    for (const auto& tip : methods) works.push_back(tip.works());
  }
  for (const auto& row : rows) post::require_finite(row, "with twice the spacing");
  warn_of_small_room(works, file.content.discretization.spacing, warnings);
  return rows;
}

std::vector<std::vector<post::Srif>> factors_of_run(const Prepared& prepared, const RunOptions& options) {
  const auto& content = prepared.file.content;
  plate::Stopwatch stopwatch = prepared.stopwatch;
  Outputs outputs(plan_of(content, options), recording_of(content, options).recorder, stopwatch);
  if (!content.load_cases.empty()) return factors_of(run_load_cases(prepared, outputs));
  Results results(outputs, *prepared.plate, prepared.tip_methods);
  run_once(prepared, results);
  return results.factors().rows();
}

}  // namespace cases
