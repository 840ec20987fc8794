#include "cases/studies/isolated_runs.hpp"

#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using cases::Ended, cases::Ledger, cases::RunOutcome, cases::RunRecord;

namespace {

const RunRecord wanted{"a", "0123456789012345", "1", RunOutcome::done};

/// A run that leaves a summary and counts itself.
Ended run(const small_run::TemporaryFolder& folder, RunOutcome outcome) {
  std::filesystem::create_directories(folder / "a");
  std::ofstream(folder / "counted", std::ios::app) << "x";
  std::ofstream(folder / "a/summary.json") << post::to_json(post::Summary());
  return {outcome, outcome == RunOutcome::done ? "" : "why"};
}

}  // namespace

TEST_CASE("repeated: what is done is kept while its results are there") {
  const small_run::TemporaryFolder folder;
  const Ledger ledger(folder.path());
  CHECK_FALSE(cases::kept_record(wanted, 2, folder.path(), ledger));
  const auto record =
      cases::new_record(wanted, 2, folder.path(), ledger, [&] { return run(folder, RunOutcome::done); });
  CHECK(record.outcome == RunOutcome::done);
  CHECK(small_run::text_of(folder / "counted") == "xx");
  CHECK(cases::kept_record(wanted, 2, folder.path(), ledger));
  CHECK_FALSE(cases::kept_record(wanted, 3, folder.path(), ledger));
  std::filesystem::remove(folder / "a/summary.json");
  CHECK_FALSE(cases::kept_record(wanted, 2, folder.path(), ledger));
}

TEST_CASE("repeated: a run that is refused is made once, and is a row with its message") {
  const small_run::TemporaryFolder folder;
  const Ledger ledger(folder.path());
  const auto record =
      cases::new_record(wanted, 3, folder.path(), ledger, [&] { return run(folder, RunOutcome::refused); });
  CHECK(small_run::text_of(folder / "counted") == "x");
  CHECK_FALSE(cases::kept_record(wanted, 1, folder.path(), ledger));
  cases::StudyRow row;
  row.labels = {"0.1"};
  const auto rows = cases::rows_of(record, row, {}, folder.path());
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].labels == row.labels);
  CHECK(rows[0].outcome == RunOutcome::refused);
  CHECK(rows[0].message == "why");
  CHECK_THROWS_WITH(
      cases::new_record(wanted, 1, folder.path(), ledger, []() -> Ended { throw std::runtime_error("full"); }),
      Catch::Contains("full"));
}
