#include "post/report/cost_model.hpp"

#include <cmath>

#include "tests/catch.hpp"

namespace {

/// A square plate of side 1 whose stages take a fixed time and one in proportion to the points.
post::SampleRun sample(double spacing, double total_points, double share = 1) {
  post::SampleRun run;
  run.spacing = spacing, run.share = share;
  const double side = std::sqrt(total_points) / spacing, points = side * side + 4 * side;
  run.summary.points = std::size_t(std::round(points)), run.summary.bonds = 8 * run.summary.points;
  const double n = run.points();
  run.summary.seconds = {{"geometry", (1e-3 + 1e-6 * n) / share},
                         {"families", 2e-6 * n / share},
                         {"parameters", 0},
                         {"solve", 1e-5 * std::pow(n, 1.5) / share},
                         {"srif", 1e-7 * n / share},
                         {"output", (0.01 + 5e-6 * n) / share}};
  double total = 0;
  for (const auto& [stage, seconds] : run.summary.seconds) total += seconds;
  run.summary.seconds.emplace_back("total", total);
  run.summary.analysis.iterations = std::size_t(std::sqrt(n));
  run.files = 1000 + 150 * n;
  run.summary.scene = {{"points", "", 100, 0}, {"factor", "", 1e6, 0}};
  return run;
}

post::Samples samples(double total_points, double share = 1) {
  return {sample(20, total_points), sample(10, total_points, share), {}, {}, 0};
}

}  // namespace

TEST_CASE("two terms: met where both are positive, by the second value elsewhere") {
  const post::TwoTerms met({2, 1, 7}, {5, 1, 16});
  CHECK(met(10, 1) == Approx(31));
  const post::TwoTerms falling({2, 1, 16}, {5, 1, 7});  // noise: no cost falls with the points
  CHECK(falling(5, 1) == Approx(7));
  CHECK(falling(10, 1) >= 7);
  const post::TwoTerms steep({2, 1, 1}, {5, 1, 10});  // would need less than nothing for no points
  CHECK(steep(10, 1) == Approx(20));
  const post::TwoTerms same({5, 1, 10}, {5, 1, 10});
  CHECK(same(5, 1) == Approx(10));
}

TEST_CASE("foretold: points, bonds, memory of a plate follow its area and its sides") {
  const double whole = 1e6, points = whole + 4 * std::sqrt(whole);
  const auto found = samples(whole);
  CHECK(post::total_points(found) == Approx(points).epsilon(1e-3));
  CHECK(post::total_bonds(found) == Approx(8 * points).epsilon(1e-3));
  CHECK(post::bytes_of_parts(found, points) == Approx(100 * points).epsilon(1e-3));  // without the factor
}

TEST_CASE("foretold: time by stages, whatever the order of the solution") {
  const double whole = 1e6;
  const auto found = samples(whole);
  const double n = post::total_points(found);
  const auto costs = post::estimated_cost(found, {n, 0, 0, 1, 1, 0.5, 1.5, 0});
  REQUIRE(costs.seconds.size() == 4);
  CHECK(costs.seconds[0].second == Approx(1e-3 + 3e-6 * n));
  CHECK(costs.seconds[1].second == Approx(1e-5 * std::pow(n, 1.5)));
  CHECK(costs.seconds[2].second == Approx(1e-7 * n));
  CHECK(costs.seconds[3].second == Approx(0.01 + 5e-6 * n));
  CHECK(costs.iterations == Approx(std::sqrt(n)).epsilon(0.01));
  CHECK(costs.files == Approx(1000 + 150 * n));
}

TEST_CASE("foretold: a busy machine does not count") {
  const double n = 1e6;
  const auto idle = post::estimated_cost(samples(n), {n, 0, 0, 1, 1, 0.5, 1.5, 0}),
             busy = post::estimated_cost(samples(n, 0.25), {n, 0, 0, 1, 1, 0.5, 1.5, 0});
  CHECK(busy.total() == Approx(idle.total()));
}

TEST_CASE("foretold: rings about tips grow until they are as wide as they get") {
  auto found = samples(1e6);
  found.factors = found.large;
  found.factors->rings = 12;
  for (auto& [stage, seconds] : found.factors->summary.seconds)
    if (stage == "srif") seconds += 0.1;
  const auto costs = post::estimated_cost(found, {1e6, 24, 0, 1, 1, 0.5, 1.5, 0});
  CHECK(costs.seconds[2].second == Approx(0.1 * std::pow(2, 1.25) + 1e-7 * 1e6));
}

TEST_CASE("foretold: steps and rows of a motion") {
  auto found = samples(1e6);
  const auto moving = [&](double steps, double rows) {
    auto run = found.large;
    run.rows = rows, run.summary.analysis.steps = std::size_t(steps);
    const double n = run.points();
    for (auto& [stage, seconds] : run.summary.seconds) {
      if (stage == "solve") seconds = n * (1e-6 + 1e-8 * steps);
      if (stage == "srif") seconds = rows * 1e-7 * n;
    }
    return run;
  };
  found.large = moving(1, 1), found.longer = moving(65, 9);
  const auto costs = post::estimated_cost(found, {1e6, 0, 1000, 400, 2, 0, 1, 0});
  CHECK(costs.seconds[1].second == Approx(1e6 * (1e-6 + 1e-8 * 1000)));
  CHECK(costs.seconds[2].second == Approx(400 * 1e-7 * 1e6));
}

TEST_CASE("foretold: the stable step of waves as short as the spacing, and of rotations") {
  auto found = samples(1e6);
  const auto limit = [](double spacing) { return 1 / std::sqrt(9 / spacing / spacing + 4); };
  found.small.summary.analysis.time_step_limit = limit(20), found.large.summary.analysis.time_step_limit = limit(10);
  CHECK(post::stable_step_of_run(found) == Approx(limit(1)));
}
