#pragma once
#include <filesystem>
#include <functional>

#include "post/studies/runs/isolated.hpp"
#include "post/studies/runs/ledger.hpp"
#include "post/studies/study.hpp"

namespace post {

/// What the ledger has of a run that was done as it is wanted, and so often, and whose results are there. `folder`: of
/// the study.
std::optional<RunRecord> kept_record(const RunRecord& wanted, std::size_t repeats, const std::filesystem::path& folder,
                                     const Ledger& ledger);

/// Makes a run so often, each in a process of its own, or until one ends otherwise, and writes what it came to into the
/// ledger. Throws std::runtime_error where the machine fails.
RunRecord new_record(RunRecord wanted, std::size_t repeats, const std::filesystem::path& folder, const Ledger& ledger,
                     const std::function<Ended()>& run);

/// The rows of a run that has come to this. `row` has what is the same in all of them: labels, spacing, horizon.
std::vector<StudyRow> rows_of(const RunRecord& record, StudyRow row, const std::vector<Wanted>& wanted,
                              const std::filesystem::path& folder);

}  // namespace post
