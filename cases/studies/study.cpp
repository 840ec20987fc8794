#include "cases/studies/study.hpp"

#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "cases/input/keys.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/digest.hpp"
#include "post/files/sinks/folder_lock.hpp"
#include "post/files/summary.hpp"
#include "post/report/say.hpp"
#include "post/studies/orders.hpp"
#include "post/studies/plots.hpp"
#include "post/studies/runs/repeated.hpp"
#include "post/studies/runs/study_files.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// The unit of a key in SI units; "" without one.
std::string si_unit(const std::string& key) {
  const auto known = std::ranges::find(keys(), key, &Key::name);
  return known == keys().end() ? "" : post::si_unit_of(known->unit);
}

post::StudyTitles titles(const Study& study) {
  post::StudyTitles result{study.title, study.axis_names(), true};
  for (const auto& run : study.runs) result.si = result.si && run.file.content.units == "SI";
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    if (const auto unit = si_unit(study.axes[i].key); result.si && !unit.empty())
      result.axes[i] += fmt::format(" [{}]", unit);
  return result;
}

post::Ended run_once(const CaseFile& file, const fs::path& folder) {
  try {
    run(file, {folder, true});
    return {"done"};
  } catch (const CaseError& error) {
    return {"refused", error.what()};
  } catch (const plate::NumericalError& error) {
    return {"failed", error.what()};
  } catch (const plate::Interrupted& asked) {
    return {"interrupted", asked.what()};
  }
}

/// The version and the time of this very program: another build of it may find other numbers.
std::string program() {
  return fmt::format("{} of {}", PDPLATE_VERSION, plate::build());
}

post::RunRecord wanted_record(const StudyRun& run) {
  return {run.folder, post::digest(resolved_toml(run.file.content)), program(), "done"};
}

}  // namespace

std::vector<std::string> StudyPlan::axis_names() const {
  std::vector<std::string> names;
  for (const auto& axis : axes) names.push_back(axis.name);
  return names;
}

post::StudyRow bare_row(const StudyRun& run) {
  post::StudyRow row;
  row.labels = run.labels;
  row.spacing = run.file.content.discretization.spacing;
  row.horizon = run.file.content.discretization.horizon();
  return row;
}

StudyOutcome run_study(const Study& study, const StudyOptions& options) {
  StudyOutcome outcome{{study.axis_names(), {}}};
  auto& table = outcome.table;
  fs::create_directories(options.folder);
  const post::FolderLock lock(options.folder);
  if (!lock.held()) throw CaseError({{"--out", options.folder.string(), "another study writes to this folder"}});
  if (options.again) fs::remove(options.folder / "runs.csv");
  const plate::StopOnSignals signals;
  post::Ledger ledger(options.folder / "runs.csv");
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const auto& run = study.runs[i];
    const auto wanted = wanted_record(run);
    const auto kept = post::kept_record(wanted, study.repeats, options.folder, ledger);
    const auto record = kept ? *kept : post::new_record(wanted, study.repeats, options.folder, ledger, [&] {
      return run_once(run.file, options.folder / run.folder);
    });
    outcome.wrong_cases += record.outcome == "refused";
    outcome.failed_numbers += record.outcome == "failed";
    outcome.killed += record.outcome == "killed" || record.outcome == "interrupted";
    const auto rows = post::rows_of(record, bare_row(run), run.wanted, options.folder);
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    post::refer_to_finest(table);
    post::write_study(table, titles(study), options.folder);
    for (const auto& row : rows) {
      const bool is_first = &row == &rows.front();
      if ((is_first && !options.quiet) || !row.message.empty())
        post::say(fmt::format("[{}/{}] {}{}\n", i + 1, study.runs.size(), post::to_text(row),
                              kept && is_first ? " (done before)" : ""));
    }
    plate::stop_if_asked("a study: the same command goes on from here");
  }
  return outcome;
}

}  // namespace cases
