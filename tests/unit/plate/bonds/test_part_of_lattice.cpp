#include "plate/bonds/part_of_lattice.hpp"

#include <fmt/format.h>
#include <mutex>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace parts;

TEST_CASE("a plate in parts: clamped, supported, mirrored and free edges, a crack across borders") {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 3, 0.7),
                 {{clamped, {"left"}, {}}, {simply_supported, {"top"}, {}}, {symmetry, {"bottom"}, {}}}, {pressure(2)});
  problem.cracks = {{{2.2, 0.2}, {2.83, 0.49}}};
  check(problem, {.processes = {2, 3, 4, 7}});
}

TEST_CASE("a plate in parts: single precision") {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 3, 0.7), {{simply_supported_hard, {"left", "right"}, {}}}, {pressure(2)});
  check(problem, {true});
}

TEST_CASE("a plate in parts: oblique edges, a held round hole, edge loads, pins and forces") {
  using enum SupportKind;
  geometry::Outline outline;
  outline.outer.vertices = {{0, 0}, {4.1, 0.03}, {4.0, 0.9}, {1.3, 1.25}};
  outline.outer.edge_names = {"bottom", "right", "slope", "left"};
  outline.holes.push_back(geometry::Circle{{2.6, 0.45}, 0.2, "hole"});
  const Load moment{EdgeMoment{.edges = {"slope"}, .value = 3}};
  const Load force{PointForce{.position = {2.561, 0.8}, .value = 5}};
  Load shear{EdgeShear{.edges = {"left"}, .value = 1}};
  shear.history.kind = History::Kind::sine, shear.history.frequency = 40;
  auto problem = problem_of(
      outline,
      {{clamped, {"hole"}, {}}, {simply_supported, {"bottom"}, {}}, {simply_supported, {}, {{2.56, 0.96}, {1.4, 1.1}}}},
      {moment, force, shear});
  check(problem);
}

TEST_CASE("a plate in parts: at rest by the diagonal and by relaxation the same bits, two levels to rounding") {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 0.5, 1.2),
                 {{clamped, {"left"}, {}}, {simply_supported, {"top"}, {}}, {symmetry, {"bottom"}, {}}}, {pressure(2)});
  problem.cracks = {{{0.15, 0.21}, {0.33, 0.67}}};
  check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0, {3, 7});
  check_rest(problem, StaticMethod::cg, Preconditioning::two_level, 1e-12);
  auto coarse = problem_of(geometry::rectangle(0, 0, 0.4, 2.4), {{clamped, {"left"}, {}}}, {pressure(2)});
  coarse.discretization.spacing = 0.02;
  check_rest(coarse, StaticMethod::adr, Preconditioning::automatic, 0);
}

TEST_CASE("a plate in parts: pieces that cracks cut off, whoever has them") {
  using enum SupportKind;
  auto problem = problem_of(geometry::rectangle(0, 0, 3, 0.7), {{clamped, {"left", "right"}, {}}}, {pressure(2)});
  problem.cracks = {{{1.131, -0.1}, {1.249, 0.8}}, {{2.831, -0.1}, {2.831, 0.8}}};
  const auto found = [&](const Communicator& all) {
    std::vector<std::array<double, 3>> result;
    const auto plate = discretise(problem, all).plate;
    for (const auto& piece : plate->pieces())
      result.push_back({double(piece.points), double(piece.free_modes), piece.position.x()});
    return result;
  };
  const auto whole = found(single_process());
  REQUIRE(whole.size() == 3);
  CHECK(whole[0][1] == 3);  // the middle is free, the others are held
  CHECK(whole[1][1] + whole[2][1] == 0);
  for (const int processes : {1, 2, 4, 7})
    thread_ranks::run(processes, [&](const Communicator& all) {
      const auto shared = found(all);
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      CHECK((shared == whole));
    });
}

TEST_CASE("a plate in parts: a ligament one row of points wide is seen by all") {
  using enum SupportKind;
  geometry::Outline outline;
  outline.outer.vertices = {{0, 0},   {1.35, 0},   {1.35, 0.35}, {1.45, 0.35}, {1.45, 0},   {3, 0},
                            {3, 0.7}, {1.45, 0.7}, {1.45, 0.36}, {1.35, 0.36}, {1.35, 0.7}, {0, 0.7}};
  for (std::size_t i = 0; i < outline.outer.vertices.size(); ++i)
    outline.outer.edge_names.push_back(fmt::format("edge{}", i));
  const auto problem = problem_of(outline, {{clamped, {"edge11"}, {}}}, {pressure(2)});
  const auto searched = [&](const Communicator& all) { return discretise(problem, all).plate->mechanisms(); };
  const bool hinge = searched(single_process()).motions > 0;
  for (const int processes : {2, 4})
    thread_ranks::run(processes, [&](const Communicator& all) {
      const bool seen = searched(all).searched;
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      CHECK(seen == !hinge);
    });
  CHECK(hinge);
}
