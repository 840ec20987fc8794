#include "cases/driver/recording.hpp"

#include "plate/formulation/discretised.hpp"
#include "post/files/checkpoints.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace cases;
using small_run::TemporaryFolder;

namespace {

/// A case, and options of its runs.
struct Recorded {
  Case content;
  RunOptions options;

  explicit Recorded(const std::filesystem::path& folder, double checkpoint_every = 0)
      : content(case_text::read(case_text::plain, {"output.fields=[\"hdf5\"]", "output.report=false"}).content),
        options{folder, true} {
    content.output.checkpoint_every = checkpoint_every;
  }
  RunPlan plan() const { return {content, options}; }
  Recording recording() const { return cases::recording(plan()); }
};

/// A run that is done, without frames.
void finish(const Recorded& run) {
  plate::Stopwatch stopwatch;
  post::Summary summary;
  summary.outcome = "done";
  run.recording().recorder.finish(summary, stopwatch);
}

}  // namespace

TEST_CASE("recording: a folder that holds something strange is refused, and so is one that is written to") {
  const TemporaryFolder folder;
  CHECK_NOTHROW(check_folder(folder / "new"));
  std::ofstream(folder / "letter.txt") << "mine";
  try {
    check_folder(folder.path());
    FAIL("it was taken");
  } catch (const RefusedFolder& refused) {
    CHECK(refused.attempt() == RefusedFolder::Attempt::write);
    CHECK_THAT(refused.what(), Catch::Contains("holds letter.txt, but no results"));
  }
  const Recorded run(folder / "run");
  const auto one = run.recording();
  CHECK_THROWS_WITH(run.recording(), Catch::Contains("another run writes to this folder"));
  CHECK_THROWS_AS(check_folder(folder / "run"), RefusedFolder);
}

TEST_CASE("recording: what is done before is that of the same case and program, with all that is wanted") {
  const TemporaryFolder folder;
  const Recorded run(folder / "run");
  CHECK_FALSE(done_before(run.plan()));
  finish(run);
  CHECK(done_before(run.plan()));
  auto other = run;
  other.content.title += "#";
  CHECK_FALSE(done_before(other.plan()));
  Recorded reported(folder / "reported");
  reported.content.output.report = true;
  finish(reported);
  CHECK_FALSE(done_before(reported.plan()));  // there is no report
  std::ofstream(folder / "reported/report.html") << "here";
  CHECK(done_before(reported.plan()));
  const auto summary = folder / "run/summary.json";
  const auto text = small_run::text_of(summary);
  const auto version = "\"" + done_before(run.plan())->version + "\"";
  std::ofstream(summary) << std::string(text).replace(text.find(version), version.size(), "\"0\"");
  CHECK_FALSE(done_before(run.plan()));
  std::ofstream(summary) << text;
  CHECK(done_before(run.plan()));
  post::Checkpoints(plate::single_process(), folder / "run", "case").write("memory", {});
  CHECK_FALSE(done_before(run.plan()));  // something goes on
}

TEST_CASE("recording: a run goes on from what it kept, and from nothing else") {
  const TemporaryFolder folder;
  Recorded run(folder / "run", 1e-9);
  {
    auto first = run.recording();
    REQUIRE(first.checkpoints);
    first.checkpoints->save([](auto&) {}, [] { return post::CellValues{}; });
  }
  run.options.resume = true;
  CHECK_FALSE(run.recording().checkpoints->goes_on());  // nothing was remembered
  std::ofstream(folder / "run" / "checkpoint") << "noise";
  try {
    run.recording();
    FAIL("it began anew");
  } catch (const RefusedFolder& refused) {
    CHECK(refused.attempt() == RefusedFolder::Attempt::go_on);
  }
  run.options.resume = false;  // begins anew
  CHECK_FALSE(run.recording().checkpoints->goes_on());
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "checkpoint"));
  CHECK_FALSE(Recorded(folder / "without").recording().checkpoints);
}

TEST_CASE("recording: what the case asks for is what is recorded, and the case is there to be read again") {
  const TemporaryFolder folder;
  const Recorded run(folder / "run");
  const auto recording = run.recording();
  CHECK_FALSE(recording.recorder.draws());
  CHECK(recording.recorder.stores());
  const auto resolved = small_run::text_of(folder / "run/case.resolved.toml");
  CHECK(resolved == resolved_toml(run.content));
  CHECK(resolved_toml(case_text::read(resolved).content) == resolved);
}

TEST_CASE("recording: in memory nothing is written") {
  const TemporaryFolder folder;
  post::ResultsInMemory in_memory;
  in_memory.wants_fields = true;
  Recorded run(folder / "run", 1);
  run.options.in_memory = &in_memory;
  CHECK_FALSE(run.recording().checkpoints);
  CHECK(in_memory.resolved == resolved_toml(run.content));
  CHECK(folder.entries() == 0);
}
