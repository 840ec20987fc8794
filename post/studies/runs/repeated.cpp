#include "post/studies/runs/repeated.hpp"

#include <stdexcept>

#include "post/studies/runs/read_summary.hpp"

namespace post {
namespace {

std::optional<Summary> summary_of(const RunRecord& record, const std::filesystem::path& folder) {
  return read_summary(folder / record.run / "summary.json");
}

}  // namespace

std::optional<RunRecord> kept_record(const RunRecord& wanted, std::size_t repeats, const std::filesystem::path& folder,
                                     const Ledger& ledger) {
  auto known = ledger.done(wanted, repeats);
  if (known && !summary_of(wanted, folder)) known.reset();
  return known;
}

RunRecord new_record(RunRecord wanted, std::size_t repeats, const std::filesystem::path& folder, const Ledger& ledger,
                     const std::function<Ended()>& run) {
  ledger.forget(wanted.run);
  std::vector<std::vector<std::pair<std::string, double>>> seconds;
  for (std::size_t i = 0; i < repeats && wanted.outcome == "done"; ++i) {
    const auto ended = isolated(run);
    if (ended.outcome == "broken") throw std::runtime_error(ended.message);
    wanted.outcome = ended.outcome, wanted.message = ended.message;
    if (const auto found = summary_of(wanted, folder); found && ended.outcome == "done")
      seconds.push_back(found->seconds);
  }
  wanted.cost = cost_of(seconds);
  ledger.put(wanted);
  return wanted;
}

std::vector<StudyRow> rows_of(const RunRecord& record, StudyRow row, const std::vector<Wanted>& wanted,
                              const std::filesystem::path& folder) {
  row.outcome = record.outcome;
  row.message = record.message;
  auto summary = summary_of(record, folder);
  if (record.outcome != "done" || !summary) return {row};
  summary->seconds = record.cost.seconds;
  if (record.cost.repeats > 1) row.seconds_min = record.cost.least, row.seconds_max = record.cost.most;
  return study_rows(row, wanted, *summary, folder / record.run);
}

}  // namespace post
