// What is told from the outline against what processes then have.
#include "cases/runs/cost_estimate.hpp"

#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace cases;

namespace {

plate::Problem problem_of(geometry::Outline outline) {
  plate::Problem problem;
  problem.outline = std::move(outline);
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.supports = {{plate::SupportKind::simply_supported, {"bottom"}, {}}};
  problem.loads = {plate::Load{}};
  problem.discretization.spacing = 0.01;
  problem.discretization.formulation = &plate::ordinary;
  return problem;
}

/// The most of any process.
ProcessesEstimate found_by_estimate(const plate::Problem& problem, int count) {
  ProcessesEstimate result{count, 0, INFINITY, 0, 0, 0, false};
  std::mutex one_by_one;
  thread_ranks::run(count, [&](const plate::Communicator& all) {
    const plate::CountedCommunicator counted(all);
    const auto plate = plate::discretise(problem, counted).plate;
    const auto before = *counted.traffic();
    plate::State state = plate::State::Zero(3, Eigen::Index(plate->points()));
    plate->constraints().fetch(state);
    const auto traffic = *counted.traffic() - before;
    double own = 0;
    for (std::uint32_t k = 0; k < plate->cloud().plate_points; ++k) own += plate->boundary().owns(k);
    const std::lock_guard guard(one_by_one);
    result.points = std::max(result.points, own), result.least_points = std::min(result.least_points, own);
    result.seen = std::max(result.seen, double(plate->cloud().plate_points));
    result.copies = std::max(result.copies, double(traffic.bytes) / 24);
    result.neighbours = std::max(result.neighbours, double(traffic.messages));
  });
  return result;
}

}  // namespace

TEST_CASE("processes foretold: points, what they see, copies and neighbours are those that they have") {
  geometry::Outline slope;
  slope.outer.vertices = {{0, 0}, {3.2, 0.03}, {3.1, 0.9}, {0.5, 1.25}};
  slope.outer.edge_names = {"bottom", "right", "slope", "left"};
  for (const auto& [outline, off] : {std::pair{geometry::rectangle(0, 0, 3, 0.7), 0.001}, {slope, 0.04}})
    for (const int count : {1, 2, 5, 7}) {
      INFO(count << " processes");
      const auto problem = problem_of(outline);
      const auto told = estimated_processes(problem, count), is = found_by_estimate(problem, count);
      CHECK(told.points == Approx(is.points).epsilon(off));
      CHECK(told.least_points == Approx(is.least_points).epsilon(off));
      CHECK(told.seen == Approx(is.seen).epsilon(off));
      // measured: up to 3 % more, as bonds do not reach into corners, and fewer where ties reach farther
      CHECK(told.copies == Approx(is.copies).epsilon(0.08));
      CHECK(told.neighbours == is.neighbours);
    }
}

TEST_CASE(
    "processes foretold: of a Galerkin plate they are those that they have, about its tips and where it is graded "
    "too") {
  auto problem = problem_of(geometry::rectangle(0, 0, 6, 1.4));
  problem.outline.holes = {geometry::Circle{{5, 0.7}, 0.2, "hole0"}};
  problem.discretization.formulation = &plate::galerkin;
  problem.cracks = {{{1.0, 0.7}, {2.2, 0.9}}};
  const bool graded = GENERATE(false, true);
  if (graded) problem.discretization.tip_spacing = 0.004;
  for (const int count : {1, 2, 5, 7}) {
    INFO(count << " processes, " << (graded ? "graded" : "a lattice"));
    const auto told = estimated_processes(problem, count), is = found_by_estimate(problem, count);
    CHECK(told.points == is.points);
    CHECK(told.least_points == is.least_points);
    // measured: up to 10 and 18 % more where points are graded, whose boxes are counted by cells of the far spacing
    CHECK(told.seen == Approx(is.seen).epsilon(graded ? 0.12 : 0.03));
    CHECK(told.copies == Approx(is.copies).epsilon(graded ? 0.2 : 0.05));
    CHECK(told.neighbours == is.neighbours);
    CHECK(told.all_made == graded);
  }
}

TEST_CASE("processes foretold: more than there are blocks are refused as by the run") {
  auto problem = problem_of(geometry::rectangle(0, 0, 3, 0.7));
  CHECK_THROWS_AS(estimated_processes(problem, 100), plate::Refused);
  problem.discretization.formulation = &plate::galerkin;
  CHECK_THROWS_AS(estimated_processes(problem, 5000), plate::Refused);
  problem.discretization.spacing = 1e-5;  // 2e10 points, which have no numbers
  CHECK_THROWS_AS(estimated_processes(problem, 4), plate::Refused);
}

TEST_CASE("processes foretold: memory and time follow what each has") {
  const SingleProcessRun run{1000, 14e6, 2e9, 0, {{"setting up", 10}, {"solution", 100}, {"files", 1}}, true, 2, 4};
  const ProcessesEstimate half{2, 500, 500, 600, 30, 1, false};
  CHECK(bytes_of_process(half, run) > 1.2e9);
  CHECK(bytes_of_process(half, run) < 1.3e9);
  auto factorised = run;
  factorised.factor = 1e9;  // which grows by MUMPS and is shared by points, not by what is seen
  CHECK(bytes_of_process(half, factorised) - bytes_of_process(half, run) == Approx(1.6e9 / 2 - 0.6e9));
  CHECK(seconds_of_processes(half, run) == Approx(6 + 50 + 0.5));
  const auto text = to_text(half, run);
  CHECK(text.find("2, of 500 to 500 points, which see up to 600") != std::string::npos);
  CHECK(text.find("2 messages with 0.96 kB to each a step") != std::string::npos);
}
