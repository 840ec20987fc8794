#include "plate/galerkin/multigrid.hpp"

#include <map>
#include <mutex>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/mesh.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

struct Found {
  std::size_t iterations = 0, points = 0;
  std::string preconditioner;
  std::map<std::uint32_t, Eigen::Vector3d> state;  // by the numbers of points
};

Found found(const Problem& problem, const Communicator& communicator) {
  const auto plate = discretise(problem, communicator).plate;
  const auto result =
      solve_static(*plate, plate->total_load(), StaticMethod::cg, Preconditioning::levels, {1e-11, 100, {}});
  if (!result.solution.converged) throw std::runtime_error(result.solution.stop_reason);
  Found own{result.solution.iterations, points_of_all(plate->boundary()), *result.preconditioner, {}};
  const auto& boundary = plate->boundary();
  for (std::uint32_t k = 0; k < plate->points(); ++k)
    if (boundary.owns(k))
      own.state[boundary.map.global.empty() ? k : boundary.map.global[k]] = result.solution.state.col(k);
  return own;
}

void check_coarser(const Problem& problem) {
  const Found whole = found(problem, single_process());
  REQUIRE(whole.points > 4000);  // there is a coarser plate
  for (const int processes : {1, 3, 7}) {
    INFO(processes << " processes");
    Found all;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Communicator& communicator) {
      auto own = found(problem, communicator);
      const std::lock_guard guard(one_by_one);
      all.iterations = own.iterations, all.points = own.points, all.preconditioner = own.preconditioner;
      all.state.merge(own.state);
    });
    CHECK(all.preconditioner == "levels");
    CHECK(all.points == whole.points);
    CHECK(std::abs(double(all.iterations) - double(whole.iterations)) <= 1);
    REQUIRE(all.state.size() == whole.state.size());
    double apart = 0, largest = 0;
    for (const auto& [number, u] : whole.state) {
      largest = std::max(largest, u.cwiseAbs().maxCoeff());
      apart = std::max(apart, (u - all.state.at(number)).cwiseAbs().maxCoeff());
    }
    CHECK(apart < 1e-10 * largest);
  }
}

Problem coarse_problem() {
  Problem problem;
  problem.outline = geometry::rectangle(0, 0, 1.2, 0.8);
  problem.section = galerkin_plate::section;
  problem.cracks = {{{0.3, 0.4}, {0.7, 0.4}}};
  problem.supports = {{SupportKind::clamped, {"left"}, {}}, {SupportKind::simply_supported, {"top"}, {}}};
  problem.discretization.spacing = 0.0125, problem.discretization.formulation = &galerkin;
  problem.loads = {Load{Pressure{.value = 1}}};
  return problem;
}

}  // namespace

TEST_CASE("a plate in parts: coarser Galerkin plates, as many iterations as by one process") {
  auto problem = coarse_problem();
  SECTION("of a lattice, on soil") {
    problem.foundations = {{20, 1, {}}};
    check_coarser(problem);
  }
  SECTION("graded, about a round hole that is held") {
    problem.outline.holes.push_back(geometry::Circle{{0.95, 0.3}, 0.1, "hole0"});
    problem.supports.push_back({SupportKind::simply_supported_hard, {"hole0"}, {}});
    problem.discretization.spacing = 0.02, problem.discretization.tip_spacing = 0.002;
    problem.discretization.spacing_growth = 0.08;
    check_coarser(problem);
  }
}

TEST_CASE("points of all: those that processes own, and of one process all") {
  auto problem = coarse_problem();
  problem.discretization.spacing = 0.1;
  problem.cracks.clear();
  const auto whole = discretise(problem).plate;
  CHECK(points_of_all(whole->boundary()) == 13 * 9);
  for (const int processes : {2, 3})
    thread_ranks::run(processes, [&](const Communicator& all) {
      const auto plate = discretise(problem, all).plate;
      if (points_of_all(plate->boundary()) != 13 * 9) throw std::runtime_error("not all points, or some twice");
    });
}
