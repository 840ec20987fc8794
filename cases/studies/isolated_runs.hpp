#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "cases/studies/ledger.hpp"
#include "cases/studies/study_table.hpp"

namespace cases {

/// Outcome of a piece of work, and why.
struct Ended {
  RunOutcome outcome = RunOutcome::done;
  std::string message = {};
  double processor_seconds = 0;  // of all threads of its process, where it ended by itself
};

/// Runs the work in a separate process, so that nothing that becomes of it ends this one; it ends with this one. The
/// work returns how it ended; what it throws is RunOutcome::broken. Threads: as many as this process would use.
Ended isolated(const std::function<Ended()>& work);

/// Record in the ledger of a run that was done as it is wanted, and so often, and whose results are there; none
/// otherwise. `folder`: of the study.
std::optional<RunRecord> kept_record(const RunRecord& wanted, std::size_t repeats, const std::filesystem::path& folder,
                                     const Ledger& ledger);

/// Makes a run so often, each in a process of its own, or until one ends otherwise, and writes what it came to into the
/// ledger. Throws std::runtime_error where the machine fails.
RunRecord new_record(RunRecord wanted, std::size_t repeats, const std::filesystem::path& folder, const Ledger& ledger,
                     const std::function<Ended()>& run);

/// The rows of a run that has come to this. `row` has what is the same in all of them: labels, spacing, horizon.
std::vector<StudyRow> rows_of(const RunRecord& record, StudyRow row, const std::vector<Wanted>& wanted,
                              const std::filesystem::path& folder);

}  // namespace cases
