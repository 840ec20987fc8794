#include "cases/runs/results.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/interruption.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

TEST_CASE("a numerical error is given the place of its point and the share of the stable step") {
  const auto plate = verified_plate::assembled(verified_plate::square(0.25));
  post::Summary summary;
  plate::NumericalError error("not finite");
  CHECK(std::string(fracture::placed(error, *plate, summary).what()) == "not finite");
  error.point = 0;
  CHECK_THAT(fracture::placed(error, *plate, summary).what(), Catch::Contains("the point is at (-0.875, -0.875)"));
  summary.analysis.time_step = 0.5, summary.analysis.time_step_limit = 1;
  CHECK_THAT(fracture::placed(error, *plate, summary).what(),
             Catch::Contains("the time step 0.5 is 0.5 of the stable"));
}

TEST_CASE("probes are read off the points about their places") {
  const auto plate = verified_plate::assembled(verified_plate::square(0.25));
  const auto probes = fracture::probes_of({{"a", {0.1, 0.2}}}, *plate);
  REQUIRE(probes.size() == 1);
  double sum = 0;
  for (const auto& share : probes[0].shares) sum += share.weight;
  CHECK(sum == Approx(1));
}

TEST_CASE("a run that fails or is interrupted is finished before that is thrown on") {
  const auto plate = verified_plate::assembled(verified_plate::square(0.25));
  std::vector<post::Summary> finished;
  const auto finish = [&](const post::Summary& summary) {
    finished.push_back(summary);
    return summary;
  };
  const auto run = [&](const std::function<void(post::Summary&)>& solve) {
    return fracture::carried_out({}, *plate, solve, finish);
  };
  CHECK(run([](post::Summary& summary) { summary.title = "solved"; }).outcome == "done");
  CHECK_THROWS_AS(run([](post::Summary& summary) {
                    summary.title = "as far as it went";
                    plate::NumericalError error("not finite");
                    error.point = 0;
                    throw error;
                  }),
                  plate::NumericalError);
  CHECK_THROWS_AS(run([](post::Summary&) { throw plate::Interrupted("stopped at step 3"); }), plate::Interrupted);
  REQUIRE(finished.size() == 3);
  CHECK(finished[0].title == "solved");
  CHECK(finished[1].title == "as far as it went");
  CHECK(finished[1].outcome == "failed: not finite; the point is at (-0.875, -0.875)");
  CHECK(finished[1].analysis.stop_reason == "not finite; the point is at (-0.875, -0.875)");
  CHECK(finished[2].outcome == "interrupted");
  CHECK(finished[2].analysis.stop_reason == "stopped at step 3");
}
