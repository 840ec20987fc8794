#include "cases/runs/cost_estimate.hpp"
#include "cases/runs/run_plan.hpp"

#include "plate/model/errors.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

/// A sample of a square of 2 by 2 whose solution takes a millisecond a point.
post::SampleRun sample(double spacing, double wider) {
  post::SampleRun result;
  const double across = 2 / (spacing * wider);
  result.spacing = wider;
  result.summary.points = std::size_t(std::lround(across * across)), result.summary.bonds = 12 * result.summary.points;
  result.summary.analysis.iterations = 10;
  result.summary.seconds = {{"solve", 1e-3 * across * across}, {"total", 1e-3 * across * across}};
  return result;
}

}  // namespace

TEST_CASE("foretell: samples that points are too wide for are taken finer, and none at all is refused") {
  const auto file = read(plain, {"discretization.spacing=0.005"});
  const auto& c = file.content;
  for (const double widest : {100.0, 6.0}) {
    std::size_t runs = 0;
    const auto told =
        cases::estimate_cost(c, [&](const auto&, const cases::ReducedRun& reduced) -> std::optional<post::SampleRun> {
          if (reduced.wider > widest) return {};
          ++runs;
          return sample(0.005, reduced.wider);
        });
    CHECK(runs >= 3);
    CHECK(told.points == Approx(160000).epsilon(0.001));
    CHECK(told.bonds == Approx(12 * 160000).epsilon(0.001));
    CHECK(double(told.sample_points) >= 160000 / (widest * widest));
    CHECK_THAT(cases::to_text(told, c), Catch::Contains("points        160000"));
  }
  const auto never = [](const auto&, const cases::ReducedRun&) { return std::optional<post::SampleRun>(); };
  CHECK_THROWS_AS(cases::estimate_cost(c, never), plate::Refused);
}

TEST_CASE("foretell: a sample does less") {
  plate::Discretization points;
  points.spacing = 0.1, points.tip_spacing = 0.01, points.spacing_growth = 0.6;
  const auto wider = cases::widened(points, 2);
  CHECK(wider.spacing == 0.2);
  CHECK(*wider.tip_spacing == 0.02);
  CHECK(wider.spacing_growth == 1);
  CHECK_FALSE(wider.hole_spacing);
  plate::Analysis motion;
  motion.kind = plate::Analysis::Kind::dynamic, motion.method = plate::Analysis::Method::central_difference;
  motion.duration = 5, motion.time_step = 1e-3;
  const auto shorter = cases::sampled(motion, {}, {2, false, 64, 1e-2}, false);
  CHECK(shorter.duration == Approx(0.64));
  CHECK_FALSE(shorter.time_step);
}

TEST_CASE("foretell: a motion is sampled for so many steps that a coarse clock can time them") {
  const auto file = read(plain, {"discretization.spacing=0.05", "section.density=1", "output.history_every=1",
                                 "analysis={kind=\"dynamic\", duration=100, method=\"central_difference\"}"});
  constexpr double step = 1e-5, clock = 0.01;  // s
  double most = 0;
  const auto told = cases::estimate_cost(file.content, [&](const auto&, const cases::ReducedRun& reduced) {
    auto result = sample(0.05, reduced.wider);
    result.summary.analysis.time_step_limit = 1e-3, result.summary.analysis.steps = std::size_t(reduced.steps);
    const double seconds = clock * std::floor((0.013 + step * reduced.steps) / clock);
    result.summary.seconds = {{"solve", seconds}, {"total", seconds}};
    most = std::max(most, reduced.steps);
    return std::optional(result);
  });
  CHECK(most > 0.1 / step);
  CHECK(told.whole.steps > 1e5);
  CHECK(told.costs.total() == Approx(step * told.whole.steps).epsilon(0.1));  // found: 0.98 of it
}
