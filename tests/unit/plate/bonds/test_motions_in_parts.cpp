// How motions of plates that processes share begin, what hits and damps them, loads and supports that move.
#include <mutex>

#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace parts;

namespace {

/// Blocks meet at x = 2.56 and at every 0.16 along y.
Problem pane() {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 3, 0.7), {{clamped, {"left"}, {}}, {simply_supported, {"top"}, {}}}, {});
  problem.cracks = {{{2.2, 0.2}, {2.83, 0.49}}};
  return problem;
}

}  // namespace

TEST_CASE("a plate in parts: a deflection and a velocity to begin with, damping of mass and stiffness") {
  auto problem = pane();
  problem.initial = Initial{Formula("0.01 * (0.7 - y) * sin(2 * x)"), Formula("3 * cos(x) * y")};
  SECTION("free") {
    check(problem);
  }
  SECTION("damped") {
    check(problem, {false, {30, 1e-5}});
  }
  SECTION("in single precision, damped by the mass") {
    check(problem, {true, {30, 0}});
  }
  SECTION("by the stiffness alone, beside a load") {
    problem.initial->deflection = {}, problem.loads = {pressure(2)};
    check(problem, {false, {0, 1e-4}});
  }
}

TEST_CASE("a plate in parts: a mass hits where four processes meet, and flies off") {
  auto problem = pane();
  problem.impact = Impact{{2.5605, 0.3207}, 2e-5, -3, 4e4};
  SECTION("alone") {
    const auto contact_forces = check(problem, {false, {}, 120});
    const auto& [place, velocity, force, touched] = contact_forces.back();
    CHECK((force == 0 && velocity > 0 && touched < 1e-4));
  }
  SECTION("on a plate that comes towards it, damped") {
    problem.initial = Initial{{}, Formula("4 * y")};
    check(problem, {false, {30, 1e-5}, 120});
  }
  SECTION("beside an edge whose points follow others") {
    problem.impact->position = {2.5605, 0.696};
    check(problem, {false, {}, 60});
  }
}

TEST_CASE("a plate in parts: a deflection that jumps, wherever it does, is refused by all processes") {
  auto problem = pane();
  for (const char* jumps : {"x > 2.3 ? 0.01 * x : 0", "x < 1.2 ? 0 : 0.01 * (0.7 - y)"})
    for (const int processes : {1, 4, 7}) {
      problem.initial = Initial{Formula(jumps), {}};
      int refused = 0;
      std::mutex one_by_one;
      thread_ranks::run(processes, [&](const Communicator& all) {
        const auto local = own(problem);
        const auto plate = discretise(local, all).plate;
        try {
          begin_of_motion(*plate, 1);
        } catch (const Jumps&) {
          const std::lock_guard guard(one_by_one);
          ++refused;
        }
      });
      CHECK(refused == processes);
    }
}

TEST_CASE("a plate in parts: forces and pressures that move across borders of processes") {
  auto problem = pane();
  const Load force{PointForce{.value = 5, .path = {{2.3, 0.31}, {2.62, 0.33}, {2.4, 0.5}}, .speed = 100}};
  Load patch{Pressure{
      .value = 3, .patch = geometry::Circle{{1.2, 0.3}, 0.1, ""}, .path = {{1.2, 0.3}, {1.5, 0.33}}, .speed = 40}};
  patch.history.kind = History::Kind::sine, patch.history.frequency = 40;
  problem.loads = {force, patch};
  SECTION("steps") {
    check(problem, {false, {}, 60});
  }
  SECTION("in single precision, beside a load that rests") {
    problem.loads.push_back(pressure(1));
    check(problem, {true});
  }
  SECTION("given by an expression, damped by the stiffness") {
    problem.loads[1].as<Pressure>()->formula = Formula("3 + x * y");
    check(problem, {false, {0, 1e-5}});
  }
}

TEST_CASE("a plate in parts: supports that move, an edge that turns, a pin, across borders of processes") {
  using enum SupportKind;
  auto problem = pane();
  const auto settlement = [&](std::size_t support, double value, double until) {
    Load load{Settlement{.support = support, .value = value}};
    load.history.kind = History::Kind::table, load.history.table = {{0, 0}, {until / 2, 0.2}, {until, 1}};
    return load;
  };
  const auto turned = [&](Load load) {
    load.as<Settlement>()->rotation = 0.02;
    return load;
  };
  const auto inclined = [&](Load load) {
    auto& settled = *load.as<Settlement>();
    settled.slope = {0.003, 0}, settled.from = {1, 0.7};
    return load;
  };
  SECTION("edges that meet") {
    problem.supports = {
        {clamped, {"left"}, {}}, {simply_supported, {"top", "right"}, {}}, {simply_supported_hard, {"bottom"}, {}}};
    for (std::size_t i = 0; i < 3; ++i) problem.loads.push_back(settlement(i, 0.01, 0.003));
  }
  SECTION("one that turns, beside a load") {
    problem.supports = {{clamped, {"left"}, {}}};
    problem.loads = {turned(settlement(0, 0.01, 0.003)), pressure(1)};
  }
  SECTION("one that comes down inclined") {
    problem.supports = {{simply_supported, {"top"}, {}}};
    problem.loads = {inclined(settlement(0, -0.02, 0.002))};
  }
  SECTION("a pin") {
    problem.supports = {{clamped, {"left"}, {}}, {simply_supported, {}, {{2.56, 0.32}}}};
    problem.loads = {settlement(1, 0.01, 0.003)};
  }
  SECTION("in single precision") {
    problem.supports = {{clamped, {"left"}, {}}};
    problem.loads = {settlement(0, 0.01, 0.003)};
    check(problem, {true});
    return;
  }
  SECTION("damped by mass and stiffness") {
    problem.supports = {{clamped, {"left"}, {}}, {simply_supported, {"top", "right"}, {}}};
    problem.loads = {turned(settlement(0, 0.01, 0.003)), settlement(1, -0.01, 0.002), pressure(1)};
    check(problem, {false, {30, 1e-5}, 40});
    return;
  }
  SECTION("oblique edges") {
    problem.outline = {};
    problem.outline.outer.vertices = {{0, 0}, {4.1, 0.03}, {4.0, 0.9}, {1.3, 1.25}};
    problem.outline.outer.edge_names = {"bottom", "right", "slope", "left"};
    problem.supports = {{clamped, {"bottom"}, {}}, {simply_supported_hard, {"slope"}, {}}};
    problem.loads = {inclined(settlement(0, 0.01, 0.003)), settlement(1, -0.01, 0.002)};
  }
  check(problem, {false, {}, 40});
}

TEST_CASE("a plate in parts: soil that lifts off, in motion and at rest") {
  auto problem = pane();
  // the part is a polygon: a cell at a circle has a place for each of many short sides
  const geometry::Polygon across{{{2.1, 0.1}, {2.9, -0.1}, {2.85, 0.6}, {2.3, 0.65}}, {"", "", "", ""}};
  problem.foundations = {{2000, 0, geometry::Hole(across), true}, {500, 0, {}, true}};
  problem.initial = Initial{{}, Formula("4 * sin(3 * x) * (0.3 - y)")};
  SECTION("in motion") {
    check(problem, {false, {30, 0}});
  }
  SECTION("in motion, beside an edge that rises") {
    Load rises{Settlement{.value = 0.01, .slope = {0, 0.005}}};
    rises.history.kind = History::Kind::table, rises.history.table = {{0, 0}, {0.001, 0.3}, {0.003, 1}};
    problem.loads = {rises};
    check(problem, {false, {30, 0}});
  }
  SECTION("at rest") {
    problem.initial.reset();
    problem.discretization.spacing = 0.02;
    problem.outline = geometry::rectangle(0, 0, 0.3, 1.3), problem.cracks = {{{0.12, 0.5}, {0.15, 0.85}}};
    problem.foundations[0].patch =
        geometry::Polygon{{{-0.1, 0.3}, {0.4, 0.25}, {0.4, 1.15}, {-0.1, 1.1}}, {"", "", "", ""}};
    const Load wheel{Pressure{.value = -50, .patch = geometry::Circle{{0.18, 0.8}, 0.1, ""}}};
    problem.loads = {wheel, pressure(0.01)};
    check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0);
    check_rest(problem, StaticMethod::cg, Preconditioning::two_level, 1e-12);
    problem.loads.push_back({Settlement{.value = 0.003, .slope = {0.001, 0}}});
    check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0);
  }
}
