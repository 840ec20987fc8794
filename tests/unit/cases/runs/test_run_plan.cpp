#include "cases/runs/run_plan.hpp"

#include "cases/input/case_file.hpp"
#include "cases/runs/outputs.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "post/files/results_in_memory.hpp"
#include "post/report/html_report.hpp"
#include "tests/catch.hpp"

TEST_CASE("run plan: growth keeps a distance from the stable step, bonds that break a larger one") {
  cases::Case c;
  c.output.history_every = 0.1;
  const auto options = cases::grid_options(c);
  CHECK(&options.analysis == &c.analysis);
  CHECK(options.row == 0.1);
  CHECK(options.most == 1);
  c.growth.emplace();
  CHECK(cases::grid_options(c).most == 0.9);
  c.growth->criterion = fracture::Growth::Criterion::bond_energy;
  CHECK(cases::grid_options(c).most == 0.8);
}

TEST_CASE("run plan: growth at rest or in motion") {
  cases::Case c;
  CHECK_FALSE(c.grows_at_rest());
  c.growth.emplace();
  CHECK(c.grows_at_rest());
  c.analysis.kind = plate::Analysis::Kind::dynamic;
  CHECK_FALSE(c.grows_at_rest());
  CHECK(c.moves());
}

TEST_CASE("run plan: a report is of a run in a folder, and shows the case") {
  cases::Case c;
  post::ResultsInMemory in_memory;
  c.title = "a plate", c.output.probes["a"] = {1, 2};
  CHECK(cases::RunPlan{c}.reports());
  CHECK_FALSE(cases::RunPlan{c, {"run", true, &in_memory}}.reports());
  const auto reported = cases::reported(c);
  CHECK(&reported.problem == &c);
  CHECK(reported.title == "a plate");
  CHECK(reported.probes.contains("a"));
  c.output.report = false;
  CHECK_FALSE(cases::RunPlan{c}.reports());
}

TEST_CASE("run plan: runs that belong to one go below its folder, or keep their results apart in memory") {
  post::ResultsInMemory in_memory;
  in_memory.wants_fields = true;
  const auto part = cases::RunOptions{"run", true, &in_memory}.part("second");
  CHECK(part.folder == "run/second");
  CHECK(part.quiet);
  CHECK(part.in_memory == &in_memory.parts.at("second"));
  CHECK(part.in_memory->wants_fields);
  CHECK(cases::RunOptions{"run"}.part("second").in_memory == nullptr);
}
