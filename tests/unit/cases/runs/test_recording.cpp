#include "cases/runs/recording.hpp"

#include "plate/formulation/discretised.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace cases;
using small_run::TemporaryFolder;

namespace {

RecordingOptions options(const std::filesystem::path& folder, double every = 0) {
  RecordingOptions result{folder, "title = \"a\"\n", "1.0"};
  result.checkpoint_every = every, result.quiet = true;
  return result;
}

/// A run that is done, without frames.
void finish(const RecordingOptions& wanted) {
  plate::Stopwatch stopwatch;
  post::Summary summary;
  summary.outcome = "done";
  recording(wanted).recorder.finish(summary, stopwatch);
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
  const auto one = recording(options(folder / "run"));
  CHECK_THROWS_WITH(recording(options(folder / "run")), Catch::Contains("another run writes to this folder"));
  CHECK_THROWS_AS(check_folder(folder / "run"), RefusedFolder);
}

TEST_CASE("recording: what is done before is that of the same case and program, with all that is wanted") {
  const TemporaryFolder folder;
  const auto wanted = options(folder / "run");
  CHECK_FALSE(done_before(wanted, false));
  finish(wanted);
  CHECK(done_before(wanted, false));
  CHECK_FALSE(done_before(wanted, true));  // there is no report
  auto other = wanted;
  other.resolved += "#";
  CHECK_FALSE(done_before(other, false));
  other = wanted, other.version = "1.1";
  CHECK_FALSE(done_before(other, false));
  post::Checkpoints(plate::single_process(), folder / "run", "case").write("memory", {});
  CHECK_FALSE(done_before(wanted, false));  // something goes on
}

TEST_CASE("recording: a run goes on from what it kept, and from nothing else") {
  const TemporaryFolder folder;
  auto wanted = options(folder / "run", 1e-9);
  {
    auto first = recording(wanted);
    REQUIRE(first.checkpoints);
    first.checkpoints->save([](auto&) {}, [] { return post::CellValues{}; });
  }
  wanted.goes_on = true;
  CHECK_FALSE(recording(wanted).checkpoints->goes_on());  // nothing was remembered
  std::ofstream(folder / "run" / "checkpoint") << "noise";
  try {
    recording(wanted);
    FAIL("it began anew");
  } catch (const RefusedFolder& refused) {
    CHECK(refused.attempt() == RefusedFolder::Attempt::go_on);
  }
  wanted.goes_on = false;  // begins anew
  CHECK_FALSE(recording(wanted).checkpoints->goes_on());
  CHECK_FALSE(std::filesystem::exists(folder / "run" / "checkpoint"));
  CHECK_FALSE(recording(options(folder / "without")).checkpoints);
}
