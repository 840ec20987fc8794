#include "plate/galerkin/part_of_cells.hpp"

#include <mutex>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace plate;

namespace {

Problem pressed_problem(geometry::Outline outline, double spacing) {
  auto problem = parts::problem_of(std::move(outline), {}, {parts::pressure(2)});
  problem.discretization.spacing = spacing, problem.discretization.formulation = &galerkin;
  problem.section.thickness = 0.1;
  return problem;
}

}  // namespace

TEST_CASE("a plate in parts: pieces that cracks cut off from a Galerkin plate, held and not") {
  auto problem = pressed_problem(geometry::rectangle(0, 0, 1.2, 0.8), 0.05);
  problem.supports = {{SupportKind::clamped, {"left"}, {}}};
  problem.cracks = {{{0.52, 0}, {0.63, 0.8}}, {{0.9, 0}, {0.9, 0.8}}};
  const auto found = [&](const Communicator& all) {
    std::vector<std::pair<std::size_t, int>> result;
    const auto plate = discretise(problem, all).plate;
    for (const auto& piece : plate->pieces()) result.emplace_back(piece.points, piece.free_modes);
    return result;
  };
  const auto whole = found(single_process());
  REQUIRE(whole.size() == 3);
  for (const int processes : {1, 2, 3, 4, 7})
    thread_ranks::run(processes, [&](const Communicator& all) {
      if (found(all) != whole) throw std::runtime_error("other pieces");
    });
}

TEST_CASE("a plate in parts: a place is of one process, be it on an edge, beside a hole, or beyond a crack") {
  geometry::Outline outline{{{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}}, {"a", "b", "c", "d", "e", "f"}},
                            {geometry::Circle{{0.25, 0.25}, 0.1, "hole0"}}};
  auto problem = pressed_problem(outline, 0.04);
  problem.cracks = {{{0.1, 0.7}, {0.4, 0.7}}};
  const std::vector<geometry::Point> at{{0.1, 0.1}, {0.25, 0.16}, {0.5, 0.5},   {0.52, 0.52},
                                        {0.3, 0.7}, {0.3, 0.701}, {0.3, 0.699}, {0.9, 0.33}};
  for (const int processes : {1, 2, 3, 4, 7}) {
    std::vector<int> owners(at.size(), 0);
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Communicator& all) {
      const auto plate = discretise(problem, all).plate;
      const std::lock_guard guard(one_by_one);
      for (std::size_t i = 0; i < at.size(); ++i) owners[i] += plate->here(at[i]);
    });
    CHECK(std::ranges::count(owners, 1) == std::ptrdiff_t(at.size()));
  }
}

TEST_CASE("a plate in parts: too few points for so many processes are refused by all") {
  const auto problem = pressed_problem(geometry::rectangle(0, 0, 1, 1), 0.25);  // 25 points
  int refused = 0;
  std::mutex one_by_one;
  thread_ranks::run(4, [&](const Communicator& all) {
    try {
      discretise(problem, all);
    } catch (const Refused& refusal) {
      const std::lock_guard guard(one_by_one);
      refused +=
          std::string(refusal.what()).find("makes 25 points, in too few rows for 4 processes") != std::string::npos;
    }
  });
  CHECK(refused == 4);
}

TEST_CASE(
    "what is seen about a tip: the widest ring, half a thickness, and as far as the edge where points are graded") {
  auto problem = pressed_problem(geometry::rectangle(0, 0, 10, 10), 0.1);
  const geometry::Tip tip{{5, 5}, {1, 0}, 0, false};
  CHECK(reach_about_tip(problem, tip) == Approx(3.8));
  CHECK(widest_window(problem) == Approx(3.5));
  problem.section.thickness = 8;
  CHECK(reach_about_tip(problem, tip) == Approx(5));
  problem.discretization.tip_spacing = 0.01;
  CHECK(reach_about_tip(problem, tip) == Approx(6));
}
