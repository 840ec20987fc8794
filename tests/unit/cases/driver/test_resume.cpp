// A run that was ended goes on from its checkpoint. Kills at random moments: tests/reliability/kills.
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <csignal>

#include "cases/driver/run.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/hdf5/state_file.hpp"
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
    if (name.string().starts_with("checkpoint")) continue;  // of another turn
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
  CHECK_THROWS_WITH(cases::run(other, options),
                    Catch::Contains("section.young: differs") && Catch::Contains("--resume"));
  for (const char* name : {"checkpoint", "checkpoint.before"}) fs::remove(options.folder / name);
  CHECK(cases::run(other, options).outcome == "done");
}

namespace {

/// A motion of 400 points with its own time step, in one formulation.
cases::CaseFile lasting(double duration, const std::string& formulation, const Overrides& more = {}) {
  Overrides all{"title=\"plate\"",
                "section.density=1",
                "discretization.spacing=0.1",
                "output.every=0.017",
                fmt::format("analysis={{kind=\"dynamic\",method=\"central_difference\",duration={}}}", duration),
                "discretization.formulation=" + formulation};
  all.insert(all.end(), more.begin(), more.end());
  return case_text::read(case_text::plain, all);
}

/// Key of what a run refuses; empty where it refuses nothing.
std::string refused_key(const cases::CaseFile& file, const cases::RunOptions& options) {
  try {
    cases::run(file, options);
  } catch (const cases::CaseError& error) {
    return error.problems()[0].key;
  }
  return "";
}

}  // namespace

TEST_CASE("a motion that has ended goes on for longer, to the files of the long one") {
  for (const std::string formulation : {"galerkin", "ordinary"}) {
    INFO(formulation);
    const small_run::TemporaryFolder scratch;
    cases::RunOptions options{scratch / "longer", true};
    cases::run(lasting(0.03, formulation), options);
    options.resume = true;
    // rows stay 0.03 / 400 apart; no frame at 0.03, which is not on output.every
    for (const double duration : {0.042, 0.06})
      CHECK(cases::run(lasting(duration, formulation), options).outcome == "done");
    CHECK(cases::run(lasting(0.06, formulation), options).outcome == "done");  // it is: nothing is made anew
    cases::run(lasting(0.06, formulation, {"output.history_every=7.5e-5"}), {scratch / "whole", true});
    for (const auto& entry : fs::directory_iterator(scratch / "whole")) {
      const auto name = entry.path().filename().string();
      INFO(name);
      REQUIRE((fs::exists(options.folder / name) || name.starts_with("checkpoint")));
      if (name == "summary.json" || name == "report.html" || name == "state.h5" || name.starts_with("checkpoint"))
        continue;
      CHECK(small_run::text_of(entry.path()) == small_run::text_of(options.folder / name));
    }
    CHECK(post::read_run(options.folder / "state.h5").resolved_case ==
          small_run::text_of(options.folder / "case.resolved.toml"));
  }
}

TEST_CASE("a motion that has ended goes on with nothing else changed") {
  const small_run::TemporaryFolder scratch;
  cases::RunOptions options{scratch / "ended", true};
  cases::run(lasting(0.03, "galerkin"), options);
  options.resume = true;
  CHECK(refused_key(lasting(0.02, "galerkin"), options) == "analysis.duration");
  CHECK(refused_key(lasting(0.040001, "galerkin"), options) == "analysis.duration");  // no whole rows
  CHECK(refused_key(lasting(0.06, "galerkin", {"load[0].value=2"}), options) == "load[0].value");
  CHECK(refused_key(lasting(0.06, "galerkin", {"output.history_every=1e-4"}), options) == "output.history_every");
  CHECK(refused_key(lasting(0.06, "galerkin", {"geometry.cracks=[]"}), options) == "geometry.cracks");
  CHECK(fs::exists(options.folder / "history.csv"));  // of the run that has ended
  CHECK(refused_key(lasting(0.03, "galerkin", {"output.history_every=7.5e-5"}), options).empty());
}

TEST_CASE("a motion without checkpoints does not go on for longer") {
  const Overrides lanczos{"title=\"plate\"", "section.density=1", "analysis.method=lanczos",
                          "discretization.formulation=galerkin"},
      steps{"title=\"plate\"", "section.density=1", "discretization.formulation=ordinary", "output.checkpoint_every=0"};
  for (const auto& some : {lanczos, steps}) {
    const auto until = [&](double duration) {
      auto all = some;
      all.insert(all.begin(), fmt::format("analysis={{kind=\"dynamic\",duration={}}}", duration));
      all.insert(all.begin(), "discretization.spacing=0.1");
      return case_text::read(case_text::plain, all);
    };
    const small_run::TemporaryFolder scratch;
    cases::RunOptions options{scratch / "ended", true};
    cases::run(until(0.03), options);
    options.resume = true;
    CHECK(refused_key(until(0.06), options) == "analysis.duration");
    CHECK(refused_key(until(0.02), options) == "analysis.duration");
    options.resume = false;
    CHECK(refused_key(until(0.06), options).empty());
  }
}
