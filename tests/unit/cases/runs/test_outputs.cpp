#include "cases/runs/outputs.hpp"

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/interruption.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/verification/verified_plate.hpp"

TEST_CASE("a numerical error is given the place of its point and the share of the stable step") {
  const auto plate = verified_plate::assembled(verified_plate::square(0.25));
  post::Summary summary;
  plate::NumericalError error("not finite");
  CHECK(std::string(cases::placed(error, *plate, summary).what()) == "not finite");
  error.point = 0;
  CHECK_THAT(cases::placed(error, *plate, summary).what(), Catch::Contains("the point is at (-0.875, -0.875)"));
  summary.analysis.time_step = 0.5, summary.analysis.time_step_limit = 1;
  CHECK_THAT(cases::placed(error, *plate, summary).what(), Catch::Contains("the time step 0.5 is 0.5 of the stable"));
}

namespace {

/// Analysis that does what it is told, and notes what the outputs have at its end.
struct Told : cases::RunningAnalysis {
  Told(cases::Outputs& run, const plate::Formulation& whole, std::function<void(post::Summary&)> work)
      : outputs(run), plate(whole), told(std::move(work)) {}
  void solve() override { told(outputs.summary()); }
  void finish() override { finished.push_back(outputs.summary().title); }
  plate::NumericalError failed(const plate::NumericalError& error) override {
    return cases::placed(error, plate, outputs.summary());
  }
  void interrupted() override { ended_by_signal = true; }

  cases::Outputs& outputs;
  const plate::Formulation& plate;
  std::function<void(post::Summary&)> told;
  std::vector<std::string> finished;
  bool ended_by_signal = false;
};

}  // namespace

TEST_CASE("a run that fails or is interrupted is written before that is thrown on") {
  const auto file = case_text::read(case_text::plain);
  const auto plate = verified_plate::assembled(verified_plate::square(0.25));
  const auto run = [&](std::function<void(post::Summary&)> work, const std::string& outcome) {
    post::ResultsInMemory written;
    plate::Stopwatch stopwatch;
    cases::Outputs outputs({file.content, {{}, true, &written}}, {std::make_unique<post::MemorySink>(written), "", ""},
                           stopwatch);
    Told told(outputs, *plate, std::move(work));
    const bool interrupts = outcome == "interrupted";
    if (outcome == "done")
      CHECK(cases::carry_out(told, outputs).outcome == "done");
    else if (interrupts)
      CHECK_THROWS_AS(cases::carry_out(told, outputs), plate::Interrupted);
    else
      CHECK_THROWS_AS(cases::carry_out(told, outputs), plate::NumericalError);
    CHECK(told.finished == std::vector<std::string>{"as far as it went"});
    CHECK(told.ended_by_signal == interrupts);
    CHECK_THAT(written.summary, Catch::Contains("\"outcome\": \"" + outcome + "\""));
    return outputs.summary().analysis.stop_reason;
  };
  run([](post::Summary& summary) { summary.title = "as far as it went"; }, "done");
  const std::string failure = "not finite; the point is at (-0.875, -0.875)";
  const auto fails = [](post::Summary& summary) {
    summary.title = "as far as it went";
    throw plate::NumericalError("not finite", 0);
  };
  CHECK(run(fails, "failed: " + failure) == failure);
  const auto stops = [](post::Summary& summary) {
    summary.title = "as far as it went";
    throw plate::Interrupted("stopped at step 3");
  };
  CHECK(run(stops, "interrupted") == "stopped at step 3");
}

TEST_CASE("outputs: probes by their names, with shares of points that show a linear field as it is") {
  const auto plate = verified_plate::assembled(verified_plate::square(0.25));
  const auto probes = cases::probes_of({{"b", {0.3, -0.41}}, {"a", {-0.99, 0.99}}}, *plate);
  REQUIRE(probes.size() == 2);
  CHECK(probes[0].name == "a");
  for (const auto& probe : probes) {
    geometry::Point at(0, 0);
    double sum = 0;
    for (const auto& [point, share, lever] : probe.shares)
      at += share * plate->cloud().positions[point] + lever, sum += share;
    CHECK(sum == Approx(1));
    CHECK((at - probe.position).norm() < 1e-6);  // measured: 1e-7, beyond the outermost points
  }
}

TEST_CASE("outputs: messages of a summary name settings by their keys") {
  const auto file = case_text::read(case_text::plain);
  post::ResultsInMemory written;
  plate::Stopwatch stopwatch;
  cases::Outputs outputs({file.content, {{}, true, &written}}, {std::make_unique<post::MemorySink>(written), "", ""},
                         stopwatch);
  auto& summary = outputs.summary();
  summary.outcome = "set `spacing`", summary.warnings = {"set `tolerance`", "edge `a`"};
  summary.growth.emplace().outcome = "set `spacing`", summary.accuracy.emplace().ended_by = "no setting";
  const auto found = outputs.finish();
  CHECK(found.outcome == "set discretization.spacing");
  CHECK(found.warnings == std::vector<std::string>{"set analysis.tolerance", "edge `a`"});
  CHECK(found.growth->outcome == "set discretization.spacing");
  CHECK(found.accuracy->ended_by == "no setting");
}
