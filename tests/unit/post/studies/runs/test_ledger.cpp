#include "post/studies/runs/ledger.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/post/small_run.hpp"

using post::Ledger, post::RunRecord;

namespace {

RunRecord record(const std::string& run, const std::string& outcome = "done") {
  RunRecord result{run, "0123456789012345", "0.1", outcome, outcome == "done" ? "" : "a message,\nin two lines"};
  result.cost =
      post::cost_of({{{"solve", 3}, {"total", 5}}, {{"solve", 1}, {"total", 4}}, {{"solve", 2}, {"total", 9}}});
  return result;
}

}  // namespace

TEST_CASE("cost: medians by stage, and the spread of the total") {
  const auto cost = record("a").cost;
  CHECK(cost.repeats == 3);
  CHECK(cost.seconds == std::vector<std::pair<std::string, double>>{{"solve", 2}, {"total", 5}});
  CHECK(cost.least == 4);
  CHECK(cost.most == 9);
  CHECK(post::cost_of({{{"total", 1}}, {{"total", 2}}}).seconds[0].second == 1.5);
  CHECK(post::cost_of({}).repeats == 0);
}

TEST_CASE("ledger: what is done is found again, with names and digests that look like numbers") {
  const small_run::TemporaryFolder folder;
  const auto file = folder / "runs.csv";
  {
    Ledger ledger(file);
    for (const char* run : {"0.05", "1e3", "a_b"}) ledger.put(record(run));
    ledger.put(record("b", "failed"));
    ledger.put(record("c"));
    ledger.forget("c");
  }
  const Ledger ledger(file);
  for (const char* run : {"0.05", "1e3", "a_b"}) {
    const auto found = ledger.done(record(run), 3);
    REQUIRE(found);
    CHECK(found->cost.seconds == record(run).cost.seconds);
    CHECK(found->cost.least == 4);
    CHECK(found->cost.most == 9);
  }
  CHECK_FALSE(ledger.done(record("a_b"), 4));  // not so often
  CHECK_FALSE(ledger.done(record("b"), 1));
  CHECK_FALSE(ledger.done(record("c"), 1));
  auto other = record("a_b");
  other.digest = "1";
  CHECK_FALSE(ledger.done(other, 1));
  other = record("a_b");
  other.version = "0.2";
  CHECK_FALSE(ledger.done(other, 1));
}

TEST_CASE("ledger: what cannot be read counts for nothing") {
  const small_run::TemporaryFolder folder;
  std::ofstream(folder / "runs.csv") << "run,digest\n./a\n";
  CHECK_FALSE(Ledger(folder / "runs.csv").done(record("a"), 1));
}
