#include <set>

#include "cases/driver/discretised.hpp"
#include "cases/driver/run.hpp"
#include "cases/studies/extremes.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "post/files/table.hpp"
#include "post/report/html/study_report.hpp"
#include "post/report/say.hpp"
#include "post/studies/study.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// The time step that is a share of the limit which the program finds for this plate.
void set_time_step(CaseFile& file, double share) {
  const auto found = discretised(file);
  const auto& plate = *found.plate;
  file.content.analysis.time_step =
      share * plate::stable_time_step(plate, plate.constraints(), plate.mass(file.content.analysis.rotary_inertia));
}

post::ExtremeRun run_row(const Extremes& extremes, const ExtremeRow& row, const ExtremeOptions& options,
                         const fs::path& folder) {
  std::vector<std::string> overrides;
  for (const auto& setting : extremes.set) overrides.push_back(setting.text);
  overrides.insert(overrides.end(), options.set.begin(), options.set.end());
  for (const auto& setting : row.set) overrides.push_back(setting.text);
  post::ExtremeRun result;
  result.folder = folder;
  plate::Stopwatch stopwatch;
  try {
    auto file = read_case(*row.case_file, overrides);
    if (row.time_step_share) set_time_step(file, *row.time_step_share);
    result.summary = run(file, {folder, true});
  } catch (const CaseError& error) {
    result.refused = error.what();
  } catch (const plate::NumericalError& error) {
    result.failed = error.what();
  }
  stopwatch.lap("row");
  result.seconds = stopwatch.total();
  return result;
}

}  // namespace

std::vector<post::Verdict> run_extremes(const Extremes& extremes, const ExtremeOptions& options) {
  const auto wanted = post::chosen({extremes.rows.begin(), extremes.rows.end()}, options.only);
  fs::create_directories(options.folder);
  std::vector<post::Verdict> verdicts;
  std::map<std::string, post::ExtremeRun> runs;
  std::set<std::string> taken{"extremes.csv"};
  for (const auto& row : extremes.rows) {
    const std::string name = post::folder_name({row.title}, taken);
    taken.insert(name);
    if (!wanted.contains(row.title)) continue;
    const auto& run = runs[row.title] = run_row(extremes, row, options, options.folder / name);
    const auto found = post::verdicts(row, run, runs);
    verdicts.insert(verdicts.end(), found.begin(), found.end());
    post::write_csv(options.folder / "extremes.csv", post::table(verdicts));
    if (!options.quiet)
      post::say(fmt::format("[{}/{}] {}: {}, {:.1f} s\n", runs.size(), wanted.size(), row.title,
                            std::ranges::all_of(found, &post::Verdict::holds) ? "holds" : "MISSED", run.seconds));
  }
  if (!verdicts.empty()) post::write_extremes_report(options.folder, extremes.title);
  return verdicts;
}

}  // namespace cases
