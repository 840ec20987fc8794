#include "cases/studies/ledger.hpp"

#include <algorithm>

#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using cases::Ledger, cases::RunOutcome, cases::RunRecord;

namespace {

RunRecord record(const std::string& run, RunOutcome outcome = RunOutcome::done) {
  RunRecord result{run, "0123456789012345", "0.1", outcome,
                   outcome == RunOutcome::done ? "" : "a message,\nin two lines"};
  result.cost =
      cases::cost_of({{{"solve", 3}, {"total", 5}}, {{"solve", 1}, {"total", 4}}, {{"solve", 2}, {"total", 9}}});
  return result;
}

}  // namespace

TEST_CASE("cost: medians by stage, and the spread of the total") {
  const auto cost = record("a").cost;
  CHECK(cost.repeats == 3);
  CHECK(cost.seconds == std::vector<std::pair<std::string, double>>{{"solve", 2}, {"total", 5}});
  CHECK(cost.least == 4);
  CHECK(cost.most == 9);
  CHECK(cases::cost_of({{{"total", 1}}, {{"total", 2}}}).seconds[0].second == 1.5);
  CHECK(cases::cost_of({}).repeats == 0);
}

TEST_CASE("ledger: what is done is found again, with names and digests that look like numbers") {
  const small_run::TemporaryFolder folder;
  {
    const Ledger ledger(folder.path());
    for (const char* run : {"0.05", "1e3", "a_b"}) ledger.put(record(run));
    ledger.put(record("b", RunOutcome::failed));
    ledger.put(record("c"));
    ledger.forget("c");
  }
  const Ledger ledger(folder.path());
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
  const Ledger ledger(folder.path());
  ledger.put(record("a"));
  for (const char* text : {"run,digest\n./a\n", "", "run,digest\n", "\"", "a,a\n1,2\n"}) {
    std::ofstream(folder / ".runs/a.csv") << text;
    CHECK_FALSE(ledger.known("a"));
    CHECK_FALSE(ledger.done(record("a"), 1));
  }
  CHECK_FALSE(ledger.known("none"));
}

TEST_CASE("ledger: every outcome has a name of its own, by which it is found") {
  for (int i = 0; i <= int(RunOutcome::broken); ++i) {
    const auto outcome = RunOutcome(i);
    CHECK(cases::run_outcome(name_of(outcome)) == outcome);
  }
  CHECK(std::string(name_of(RunOutcome::interrupted)) == "interrupted");
  CHECK_FALSE(cases::run_outcome("lost"));
}

TEST_CASE("ledger: a record with one bit turned over counts for nothing") {
  const small_run::TemporaryFolder folder;
  const Ledger ledger(folder.path());
  ledger.put(record("a"));
  REQUIRE(ledger.known("a"));
  const auto text = small_run::text_of(folder / ".runs/a.csv");
  for (std::size_t i = 0; i < 8 * text.size(); ++i) {
    auto damaged = text;
    damaged[i / 8] = char(damaged[i / 8] ^ (1 << i % 8));
    std::ofstream(folder / ".runs/a.csv", std::ios::binary) << damaged;
    if (ledger.known("a")) FAIL("bit " << i);
  }
  std::ofstream(folder / ".runs/a.csv", std::ios::binary) << text.substr(0, text.rfind('#'));
  CHECK_FALSE(ledger.known("a"));
  std::ofstream(folder / ".runs/a.csv", std::ios::binary) << text;
  CHECK(ledger.known("a"));
}

TEST_CASE("ledger: a message is kept as it was said, and is a line of runs.csv") {
  const small_run::TemporaryFolder folder;
  const Ledger ledger(folder.path());
  ledger.put(record("b", RunOutcome::failed));
  CHECK(ledger.known("b")->message == "a message,\nin two lines");
  CHECK(ledger.known("b")->outcome == RunOutcome::failed);
  cases::write_records(folder / "runs.csv", {record("a"), *ledger.known("b")});
  const auto text = small_run::text_of(folder / "runs.csv");
  CHECK(std::ranges::count(text, '\n') == 3);
  CHECK_THAT(text, Catch::Contains("\"a message,; in two lines\""));
}

TEST_CASE("ledger: programs of one package are the same, whatever their instruction set") {
  const auto same = [](const std::string& one, const std::string& other) {
    return cases::same_program({"a", "0", one, RunOutcome::done}, {"a", "0", other, RunOutcome::done});
  };
  CHECK(same("0.1 of 17 AVX2", "0.1 of 17 AVX-512"));
  CHECK(same("0.1 of 17", "0.1 of 17 AVX2"));
  CHECK_FALSE(same("0.1 of 17", "0.1 of 18"));
  CHECK_FALSE(same("0.1 of 17", "0.2 of 17"));
}
