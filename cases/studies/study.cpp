#include "cases/studies/study.hpp"

#include <fmt/format.h>

#include "cases/driver/run.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/model/process.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/digest.hpp"
#include "post/files/sinks/folder_lock.hpp"
#include "post/files/table.hpp"
#include "post/files/whole_file.hpp"
#include "post/report/html/study_report.hpp"
#include "post/report/say.hpp"
#include "post/studies/advice.hpp"
#include "post/studies/orders.hpp"
#include "post/studies/plots.hpp"
#include "post/studies/runs/isolated.hpp"
#include "post/studies/runs/ledger.hpp"
#include "post/studies/runs/read_summary.hpp"

namespace cases {
namespace {

namespace fs = std::filesystem;

/// The unit of a key in SI units; "" without one.
std::string si_unit(const std::string& key) {
  static const std::map<std::string, std::string> units{{"length", "m"},
                                                        {"time", "s"},
                                                        {"1/time", "1/s"},
                                                        {"force", "N"},
                                                        {"force/length", "N/m"},
                                                        {"force/length^2", "Pa"},
                                                        {"mass/length^3", "kg/m\u00b3"}};
  const auto known = std::ranges::find(keys(), key, &Key::name);
  const auto unit = known == keys().end() ? units.end() : units.find(known->unit);
  return unit == units.end() ? "" : unit->second;
}

post::StudyTitles titles(const Study& study) {
  post::StudyTitles result{study.title, study.axis_names(), true};
  for (const auto& run : study.runs) result.si = result.si && run.file.content.units == "SI";
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    if (const auto unit = si_unit(study.axes[i].key); result.si && !unit.empty())
      result.axes[i] += fmt::format(" [{}]", unit);
  return result;
}

void write(const Study& study, const post::StudyTable& table, const fs::path& folder) {
  post::write_csv(folder / "study.csv", post::table(table));
  post::write_whole(folder / "study.json", post::to_json(study.title, table));
  if (post::refinement(table.rows)) post::write_csv(folder / "orders.csv", post::orders_table(table));
  for (const auto& [name, plot] : post::study_plots(table, titles(study)))
    post::write_whole(folder / name, post::to_svg(plot));
  post::write_study_report(folder, study.title);
}

post::Ended run_once(const CaseFile& file, const fs::path& folder) {
  return post::isolated([&]() -> post::Ended {
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
  });
}

/// The version and the time of this very program: another build of it may find other numbers.
std::string program() {
  return fmt::format("{} of {}", PDPLATE_VERSION, plate::build());
}

post::RunRecord wanted_record(const StudyRun& run) {
  return {run.folder, post::digest(resolved_toml(run.file.content)), program(), "done"};
}

/// What the ledger has of a run that this program has done with the same settings.
std::optional<post::RunRecord> kept_record(const StudyRun& run, std::size_t repeats, const fs::path& folder,
                                           const post::Ledger& ledger) {
  auto known = ledger.done(wanted_record(run), repeats);
  if (known && !post::read_summary(folder / run.folder / "summary.json")) known.reset();
  return known;
}

/// What a run comes to now. Throws where the machine fails.
post::RunRecord new_record(const StudyRun& run, std::size_t repeats, const fs::path& folder, post::Ledger& ledger) {
  auto record = wanted_record(run);
  const auto summary = folder / run.folder / "summary.json";
  ledger.forget(run.folder);
  std::vector<std::vector<std::pair<std::string, double>>> seconds;
  for (std::size_t i = 0; i < repeats && record.outcome == "done"; ++i) {
    const auto ended = run_once(run.file, folder / run.folder);
    if (ended.outcome == "broken") throw std::runtime_error(ended.message);
    record.outcome = ended.outcome, record.message = ended.message;
    if (const auto found = post::read_summary(summary); found && ended.outcome == "done")
      seconds.push_back(found->seconds);
  }
  record.cost = post::cost_of(seconds);
  ledger.put(record);
  return record;
}

std::vector<post::StudyRow> rows_of(const StudyRun& run, const post::RunRecord& record, const fs::path& folder) {
  auto row = bare_row(run);
  row.outcome = record.outcome;
  row.message = record.message;
  auto summary = post::read_summary(folder / run.folder / "summary.json");
  if (record.outcome != "done" || !summary) return {row};
  summary->seconds = record.cost.seconds;
  if (record.cost.repeats > 1) row.seconds_min = record.cost.least, row.seconds_max = record.cost.most;
  return post::study_rows(row, run.wanted, *summary, folder / run.folder);
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
  if (options.again) fs::remove(options.folder / "runs.csv");
  const post::FolderLock lock(options.folder);
  if (!lock.held()) throw CaseError({{"--out", options.folder.string(), "another study writes to this folder"}});
  const plate::StopOnSignals signals;
  post::Ledger ledger(options.folder / "runs.csv");
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const auto& run = study.runs[i];
    const auto kept = kept_record(run, study.repeats, options.folder, ledger);
    const auto record = kept ? *kept : new_record(run, study.repeats, options.folder, ledger);
    outcome.wrong_cases += record.outcome == "refused";
    outcome.failed_numbers += record.outcome == "failed";
    outcome.killed += record.outcome == "killed";
    const auto rows = rows_of(run, record, options.folder);
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    post::refer_to_finest(table);
    write(study, table, options.folder);
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

void print(const Study& study, const StudyOutcome& outcome, const fs::path& folder) {
  fmt::print("{}\n{}", study.title, post::to_text(outcome.table));
  if (!post::orders(outcome.table).empty()) fmt::print("\nfitted orders\n{}", post::orders_text(outcome.table));
  fmt::print("\nseconds by stage\n{}", post::costs_text(outcome.table));
  for (const auto& sentence : post::advice(outcome.table)) fmt::print("{}\n", sentence);
  fmt::print("results in {}\n", folder.string());
}

}  // namespace cases
