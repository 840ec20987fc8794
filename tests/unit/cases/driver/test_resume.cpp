// A run that was ended goes on from its checkpoint. Kills at random moments: tests/reliability/kills.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "cases/driver/run.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/summary.hpp"
#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

namespace fs = std::filesystem;

namespace {

using Overrides = std::vector<std::string>;

/// A plate of 1,600 points that moves, with a checkpoint at nearly every step.
const Overrides motion{"section.density=1",
                       "analysis={kind=\"dynamic\",duration=0.05}",
                       "output.checkpoint_every=1e-9",
                       "output.every=0.01",
                       "output.history_every=0.001",
                       "discretization.formulation=ordinary"};

/// Sends itself a signal after so many steps, as somebody beside it would: the folder has so many frames by then.
std::string interrupted(const cases::CaseFile& file, const cases::RunOptions& options) {
  const plate::StopOnSignals guard;  // the run may have ended by then
  const pid_t parent = getpid(), child = fork();
  if (child == 0) {  // waits for the third frame
    while (!fs::exists(options.folder / "fields_0002.vtu") && getppid() == parent) usleep(200);
    if (getppid() == parent) kill(parent, SIGTERM);
    _exit(0);
  }
  std::string said;
  try {
    cases::run(file, options);
  } catch (const plate::Interrupted& asked) {
    said = asked.what();
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return said;
}

}  // namespace

TEST_CASE("a run that a signal ends has its tables, and goes on from there to the same end") {
  const small_run::TemporaryFolder scratch;
  const auto file = case_text::read(case_text::plain, motion);
  cases::run(file, {scratch / "whole", true});
  cases::RunOptions options{scratch / "ended", true};
  CHECK_THAT(interrupted(file, options), Catch::StartsWith("asked to stop at step "));
  CHECK_THAT(small_run::text_of(options.folder / "summary.json"), Catch::Contains("\"outcome\": \"interrupted\""));
  for (const char* name : {"history.csv", "reactions.csv", "fields.pvd", "state.h5", "checkpoint", "report.html"})
    CHECK(fs::exists(options.folder / name));
  options.resume = true;
  cases::run(file, options);
  std::size_t same = 0;
  for (const auto& entry : fs::directory_iterator(scratch / "whole")) {
    const auto name = entry.path().filename();
    INFO(name);
    REQUIRE(fs::exists(options.folder / name));
    if (name == "summary.json" || name == "report.html" || name == "state.h5") continue;  // times; tests/reliability
    CHECK(small_run::text_of(entry.path()) == small_run::text_of(options.folder / name));
    ++same;
  }
  CHECK(same >= 12);
  CHECK_FALSE(fs::exists(options.folder / "checkpoint"));
  const auto written = fs::last_write_time(options.folder / "history.csv");
  CHECK(cases::run(file, options).outcome == "done");  // it is: nothing is made anew
  CHECK(fs::last_write_time(options.folder / "history.csv") == written);
}

TEST_CASE("what cannot go on is refused, where there is nothing it begins anew") {
  const small_run::TemporaryFolder scratch;
  const auto file = case_text::read(case_text::plain, motion);
  cases::RunOptions options{scratch / "ended", true};
  interrupted(file, options);
  options.resume = true;
  const auto other = case_text::read(case_text::plain, [] {
    auto overrides = motion;
    overrides.push_back("section.young=5000");
    return overrides;
  }());
  CHECK_THROWS_WITH(cases::run(other, options), Catch::Contains("--resume") && Catch::Contains("is of another run"));
  for (const char* name : {"checkpoint", "checkpoint.before"}) fs::remove(options.folder / name);
  CHECK(cases::run(other, options).outcome == "done");
}
