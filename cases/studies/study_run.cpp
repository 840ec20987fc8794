#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <thread>

#include "cases/driver/run.hpp"
#include "cases/input/keys.hpp"
#include "cases/studies/isolated_runs.hpp"
#include "cases/studies/orders.hpp"
#include "cases/studies/study.hpp"
#include "cases/studies/study_files.hpp"
#include "cases/studies/study_plots.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/run_folder.hpp"
#include "post/files/summary.hpp"
#include "post/report/quantity.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

constexpr std::size_t most_parts = 10000;  // as many as a study has runs

std::optional<std::size_t> number_in(const char* begin, const char* end) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<StudyPart> part_of(const std::string& text) {
  const char *begin = text.data(), *end = begin + text.size(), *stroke = std::find(begin, end, '/');
  if (stroke == end) return std::nullopt;
  const auto number = number_in(begin, stroke), of = number_in(stroke + 1, end);
  if (!number || !of || *number < 1 || *number > *of || *of > most_parts) return std::nullopt;
  return StudyPart{*number, *of};
}

std::string wrong_part(const std::string& text) {
  if (part_of(text)) return {};
  return fmt::format("{} given, must be a part as 3/16: from 1/16 to 16/16, of at most {}", text, most_parts);
}

std::vector<std::size_t> share(const std::vector<std::uint64_t>& weights, const StudyPart& part) {
  std::vector<std::size_t> order(weights.size()), own;
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return weights[i]; });
  std::vector<std::uint64_t> sums(part.of);
  for (const std::size_t i : order) {
    const auto least = std::ranges::min_element(sums);
    *least += weights[i];
    if (least - sums.begin() == std::ptrdiff_t(part.number - 1)) own.push_back(i);
  }
  std::ranges::sort(own);
  return own;
}

std::uint64_t weight(double area, double spacing) {
  constexpr double most = 1e5;  // across the plate: 10,000 runs of it do not exceed 64 bits
  const double across = std::sqrt(area) / spacing;
  const auto n = std::uint64_t(std::llround(across > 1 ? std::min(across, most) : 1));
  return n * n * n;
}

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Use = post::NamedLock::Use;

constexpr auto patience = 2s;  // for the children of a process that was killed: they end with the system's next look
constexpr auto pause = 200ms;  // between looks at a run that another process makes

/// The unit of a key in SI units; "" without one.
std::string si_unit(const std::string& key) {
  const auto known = std::ranges::find(keys(), key, &Key::name);
  return known == keys().end() ? "" : post::si_unit_of(known->unit);
}

StudyTitles titles(const Study& study) {
  StudyTitles result{study.title, study.axis_names(), true};
  for (const auto& run : study.runs) result.si = result.si && run.file.content.units == "SI";
  for (std::size_t i = 0; i < study.axes.size(); ++i)
    if (const auto unit = si_unit(study.axes[i].key); result.si && !unit.empty())
      result.axes[i] += fmt::format(" [{}]", unit);
  return result;
}

Ended ended_run(const CaseFile& file, const fs::path& folder) {
  try {
    run(file, {folder, true});
    return {RunOutcome::done};
  } catch (const CaseError& error) {
    return {RunOutcome::refused, error.what()};
  } catch (const plate::NumericalError& error) {
    return {RunOutcome::failed, error.what()};
  } catch (const plate::Interrupted& asked) {
    return {RunOutcome::interrupted, asked.what()};
  }
}

/// Outcome of the runs of a study so far.
class Made {
public:
  Made(const Study& study, const StudyOptions& options) : study_(study), options_(options) {}

  void take(std::size_t i, const RunRecord& record, bool before) {
    const auto& run = study_.runs[i];
    outcome_.wrong_cases += record.outcome == RunOutcome::refused;
    outcome_.failed_numbers += record.outcome == RunOutcome::failed;
    outcome_.killed += record.outcome == RunOutcome::killed || record.outcome == RunOutcome::interrupted;
    outcome_.missing += record.outcome == RunOutcome::missing;
    auto& [kept, rows] = made_[i];
    kept = record;
    rows = rows_of(record, bare_row(run), run.wanted, options_.folder);
    for (const auto& row : rows) {
      const bool is_first = &row == &rows.front();
      if ((is_first && !options_.quiet && !options_.merge) || !row.message.empty())
        post::say(fmt::format("[{}/{}] {}{}\n", i + 1, study_.runs.size(), to_text(row),
                              before && is_first && !options_.merge ? " (done before)" : ""));
    }
  }

  /// Outcome so far, in the order of the study.
  StudyOutcome outcome() const {
    auto result = outcome_;
    result.table.axes = study_.axis_names();
    for (const auto& [i, run] : made_)
      result.table.rows.insert(result.table.rows.end(), run.rows.begin(), run.rows.end());
    refer_to_finest(result.table);
    return result;
  }

  void write() const {
    std::vector<RunRecord> records;
    for (const auto& [i, run] : made_)
      if (run.record.outcome != RunOutcome::missing) records.push_back(run.record);
    write_records(options_.folder / "runs.csv", records);
    write_study(outcome().table, titles(study_), options_.folder);
  }

private:
  struct MadeRun {
    RunRecord record;
    std::vector<StudyRow> rows;
  };
  const Study& study_;
  const StudyOptions& options_;
  StudyOutcome outcome_;
  std::map<std::size_t, MadeRun> made_;
};

/// Reason why a run that is known to the ledger, or is not, cannot be merged; empty where it can.
std::string lack(const std::optional<RunRecord>& known, const RunRecord& wanted, std::size_t repeats,
                 const fs::path& folder) {
  if (!known) return "not made to its end (or its record is damaged)";
  if (known->digest != wanted.digest) return "made with other settings";
  if (!same_program(*known, wanted)) return "made by another build of the program: " + known->version;
  if (known->outcome == RunOutcome::interrupted) return "was interrupted";
  if (known->outcome != RunOutcome::done) return {};
  if (known->cost.repeats < repeats) return fmt::format("made {} times of {}", known->cost.repeats, repeats);
  return post::read_summary(folder / wanted.run / "summary.json") ? "" : "its results are not there";
}

StudyOutcome merged(const Study& study, const StudyOptions& options, const Ledger& ledger) {
  Made made(study, options);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const auto& wanted = study.runs[i].record;
    const post::NamedLock lock(ledger.locks(), "run " + wanted.run, Use::together);  // nobody makes it meanwhile
    const auto known = ledger.known(wanted.run);
    auto missing = wanted;
    missing.outcome = RunOutcome::missing;
    missing.message = lock.held() ? lack(known, wanted, study.repeats, options.folder) : "another process makes it now";
    made.take(i, missing.message.empty() ? *known : missing, true);
  }
  made.write();
  auto outcome = made.outcome();
  if (outcome.missing > 0) post::say(fmt::format("{} of {} runs are missing\n", outcome.missing, study.runs.size()));
  return outcome;
}

/// The record of a run: as it was made before, or now; nothing where another process makes it.
std::optional<std::pair<RunRecord, bool>> record_of(const StudyRun& run, std::size_t repeats, const fs::path& folder,
                                                    const Ledger& ledger) {
  const post::NamedLock lock(ledger.locks(), "run " + run.folder, Use::alone);
  if (!lock.held()) return std::nullopt;
  if (auto kept = kept_record(run.record, repeats, folder, ledger)) return std::pair(std::move(*kept), true);
  const auto work = [&] { return ended_run(run.file, folder / run.folder); };
  return std::pair(new_record(run.record, repeats, folder, ledger, work), false);
}

StudyOutcome make(const Study& study, const StudyOptions& options, const Ledger& ledger) {
  std::vector<std::uint64_t> weights;
  for (const auto& run : study.runs) {
    const auto& c = run.file.content;
    weights.push_back(weight(geometry::area(c.outline), c.discretization.spacing));
  }
  auto left = share(weights, options.part.value_or(StudyPart()));
  if (options.part && !options.quiet)
    post::say(fmt::format("part {}: {} of {} runs\n", options.part->text(), left.size(), study.runs.size()));
  if (options.again)
    for (const std::size_t i : left) ledger.forget(study.runs[i].folder);
  const plate::StopOnSignals signals;
  Made made(study, options);
  while (!left.empty()) {
    const auto before = left.size();
    std::erase_if(left, [&](std::size_t i) {
      const auto record = record_of(study.runs[i], study.repeats, options.folder, ledger);
      if (record) made.take(i, record->first, record->second);
      if (record && !options.part) made.write();
      plate::stop_if_asked("a study: the same command goes on from here");
      return record.has_value();
    });
    if (left.size() == before) std::this_thread::sleep_for(pause);
  }
  return made.outcome();
}

}  // namespace

StudyOutcome run_study(const Study& study, const StudyOptions& options) {
  const auto& folder = options.folder;
  const Ledger ledger(folder);
  if (options.merge && !fs::exists(ledger.locks()))
    throw CaseError({{"--out", folder.string(), "holds nothing of a study that could be merged"}});
  fs::create_directories(ledger.locks().parent_path());
  const auto lock = [&](const std::string& name, Use use) {
    return post::NamedLock(ledger.locks(), name, use, patience);
  };
  const auto whole = lock("study", options.part || options.merge ? Use::together : Use::alone);
  if (!whole.held()) throw CaseError({{"--out", folder.string(), "another study writes to this folder"}});
  if (options.merge) {
    const auto own = lock("merge", Use::alone);
    if (!own.held()) throw CaseError({{"--merge", folder.string(), "another process merges in this folder"}});
    return merged(study, options, ledger);
  }
  if (!options.part) return make(study, options, ledger);
  const auto part = options.part->text();
  const auto own = lock("part " + part, Use::alone);
  if (!own.held()) throw CaseError({{"--part", part, "another process works on this part in this folder"}});
  if (!own.works())
    post::say(folder.string() +
              ": this file system knows no locks: start no part twice at the same time, no study beside it\n");
  return make(study, options, ledger);
}

}  // namespace cases
