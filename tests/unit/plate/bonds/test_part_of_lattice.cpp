#include "plate/bonds/part_of_lattice.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <mutex>

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/parts/mechanisms.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/refused.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/solution.hpp"
#include "plate/solve/static_solver.hpp"
#include "tests/unit/plate/model/ranks/thread_ranks.hpp"

using namespace plate;

namespace {

/// Where and how a motion ends, whoever computed it.
struct End {
  double limit = 0;                          // of the time step
  std::vector<std::array<double, 4>> books;  // strain, kinetic, discrete and outer energy of every row
  std::map<std::array<long, 2>, std::array<double, 3>> state;  // by cell
};

Problem problem_of(geometry::Outline outline, std::vector<Support> supports, std::vector<Load> loads) {
  Problem problem;
  problem.outline = std::move(outline);
  problem.section = {1000, 0.3, 0.05, 5.0 / 6, 2};
  problem.supports = std::move(supports);
  problem.loads = std::move(loads);
  problem.discretization.spacing = 0.01;
  problem.discretization.formulation = &ordinary;
  return problem;
}

/// With formulas of its own: each is evaluated by one thread at a time.
Problem own(Problem problem) {
  for (auto& load : problem.loads)
    if (load.formula.given()) load.formula = Formula(load.formula.text());
  return problem;
}

/// What this process, or the only one, has of 30 steps.
End moved(const Problem& given, bool mixed) {
  constexpr std::size_t steps = 30;
  const auto problem = own(given);
  const auto plate = discretise(problem).plate;
  const auto& cloud = plate->cloud();
  const auto cell = [&](std::uint32_t k) { return geometry::cell_of(plate->boundary().lattice[k]); };
  const auto mass = plate->mass();
  State start(3, mass.cols());
  for (std::uint32_t k = 0; k < cloud.size(); ++k)
    for (int c = 0; c < 3; ++c) start(c, k) = std::sin(double(7 * cell(k)[0] + 13 * cell(k)[1] + c));
  End end;
  end.limit = stable_time_step(*plate, plate->constraints(), mass, start);
  const auto part = part_of_lattice(problem.outline, problem.discretization);
  DynamicOptions options{0.9 * end.limit, steps, 10};
  if (mixed) options.single = plate->single_precision();
  central_differences(*plate, plate->constraints(), mass, plate->loads(), options, [&](const Instant& now) {
    end.books.push_back({now.strain_energy, now.kinetic_energy, now.discrete_kinetic_energy, now.external_work});
    if (now.step < steps) return;
    for (std::uint32_t k = 0; k < cloud.plate_points; ++k)
      if (!part || part->own.contains(cell(k)))
        end.state[cell(k)] = {now.state(0, k), now.state(1, k), now.state(2, k)};
  });
  return end;
}

End moved_by(int processes, const Problem& problem, bool mixed) {
  End all;
  std::mutex one_by_one;
  thread_ranks::run(processes, [&](const Ranks& ranks) {
    End own = moved(problem, mixed);
    const std::lock_guard guard(one_by_one);
    all.state.merge(own.state);
    if (ranks.rank() == 0) all.limit = own.limit, all.books = own.books;
    CHECK(own.state.empty());  // nobody else has any of these points
  });
  return all;
}

/// 1 process against the ordinary program, any other number against 1, bit for bit.
void check(const Problem& problem, bool mixed = false) {
  const End whole = moved(problem, mixed), one = moved_by(1, problem, mixed);
  REQUIRE(whole.state.size() == one.state.size());
  CHECK(one.limit == Approx(whole.limit).epsilon(1e-9));
  double largest = 0, apart = 0;
  for (const auto& [cell, value] : whole.state)
    for (std::size_t c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(value[c]));
      apart = std::max(apart, std::abs(value[c] - one.state.at(cell)[c]));
    }
  CHECK(largest > 0);
  CHECK(apart < (mixed ? 1e-5 : 1e-10) * largest);
  for (const int processes : {2, 3, 4, 7}) {
    INFO(processes << " processes");
    const End many = moved_by(processes, problem, mixed);
    CHECK(many.limit == one.limit);
    CHECK(many.books == one.books);
    CHECK((many.state == one.state));
  }
}

/// What this process, or the only one, has of an equilibrium, and the iterations to it.
struct Rest {
  std::size_t iterations = 0;
  double strain = 0;
  std::vector<std::array<double, 3>> pieces;  // points, free motions, abscissa
  std::map<std::array<long, 2>, std::array<double, 3>> state;
};

Rest at_rest(const Problem& given, StaticMethod method, Preconditioning wanted) {
  const auto problem = own(given);
  const auto plate = discretise(problem).plate;
  const auto part = part_of_lattice(problem.outline, problem.discretization);
  const auto found = solve_static(*plate, plate->total_load(), method, wanted, {1e-7, 20000, {}}).solution;
  CHECK(found.converged);
  Rest rest{found.iterations, plate->strain_energy(found.state), {}, {}};
  for (const auto& piece : plate->pieces())
    rest.pieces.push_back({double(piece.points), double(piece.free_modes), piece.position.x()});
  for (std::uint32_t k = 0; k < plate->cloud().plate_points; ++k)
    if (const auto cell = geometry::cell_of(plate->boundary().lattice[k]); !part || part->own.contains(cell))
      rest.state[cell] = {found.state(0, k), found.state(1, k), found.state(2, k)};
  return rest;
}

/// `bound`: of how far apart states are for different numbers of processes, over the largest; 0: the same bits.
void check_rest(const Problem& problem, StaticMethod method, Preconditioning wanted, double bound) {
  const Rest whole = at_rest(problem, method, wanted);
  Rest one;
  for (const int processes : {1, 3, 7}) {
    INFO(processes << " processes");
    Rest all;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Ranks& ranks) {
      Rest own = at_rest(problem, method, wanted);
      const std::lock_guard guard(one_by_one);
      all.state.merge(own.state);
      if (ranks.rank() == 0) all.iterations = own.iterations, all.strain = own.strain, all.pieces = own.pieces;
    });
    REQUIRE(all.state.size() == whole.state.size());
    CHECK((all.pieces == whole.pieces));
    CHECK(std::abs(double(all.iterations) - double(whole.iterations)) <= 0.01 * double(whole.iterations));
    if (processes == 1) one = all;
    double largest = 0, apart = 0, apart_of_whole = 0;
    for (const auto& [cell, value] : whole.state)
      for (std::size_t c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(value[c]));
        apart_of_whole = std::max(apart_of_whole, std::abs(value[c] - all.state.at(cell)[c]));
        apart = std::max(apart, std::abs(one.state.at(cell)[c] - all.state.at(cell)[c]));
      }
    CAPTURE(apart / largest, apart_of_whole / largest, all.strain / one.strain - 1);
    CHECK(largest > 0);
    CHECK(apart <= bound * largest);
    CHECK(apart_of_whole < 1e-7 * largest);
    CHECK(std::abs(all.strain - one.strain) <= bound * one.strain);
    if (bound == 0) CHECK(all.iterations == one.iterations);
  }
}

Load pressure(double value) {
  Load load;
  load.value = value;
  return load;
}

}  // namespace

TEST_CASE("a plate in parts: clamped, supported, mirrored and free edges, a crack across borders") {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 3, 0.7),
                 {{clamped, {"left"}, {}}, {simply_supported, {"top"}, {}}, {symmetry, {"bottom"}, {}}}, {pressure(2)});
  problem.cracks = {{{2.2, 0.2}, {2.83, 0.49}}};
  check(problem);
}

TEST_CASE("a plate in parts: single precision") {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 3, 0.7), {{simply_supported_hard, {"left", "right"}, {}}}, {pressure(2)});
  check(problem, true);
}

TEST_CASE("a plate in parts: oblique edges, a held round hole, edge loads, pins and forces") {
  using enum SupportKind;
  geometry::Outline outline;
  outline.outer.vertices = {{0, 0}, {4.1, 0.03}, {4.0, 0.9}, {1.3, 1.25}};
  outline.outer.edge_names = {"bottom", "right", "slope", "left"};
  outline.holes.push_back(geometry::Circle{{2.6, 0.45}, 0.2, "hole"});
  Load moment, force, shear;
  moment.kind = Load::Kind::edge_moment, moment.edges = {"slope"}, moment.value = 3;
  shear.kind = Load::Kind::edge_shear, shear.edges = {"left"}, shear.value = 1,
  shear.history.kind = History::Kind::sine, shear.history.frequency = 40;
  force.kind = Load::Kind::point_force, force.position = {2.561, 0.8}, force.value = 5;
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
  check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0);
  check_rest(problem, StaticMethod::cg, Preconditioning::two_level, 1e-12);
  auto coarse = problem_of(geometry::rectangle(0, 0, 0.4, 2.4), {{clamped, {"left"}, {}}}, {pressure(2)});
  coarse.discretization.spacing = 0.02;
  check_rest(coarse, StaticMethod::adr, Preconditioning::automatic, 0);
}

TEST_CASE(
    "a plate in parts: soil that goes on beneath a crack along a border, springs, loads along lines, an expression") {
  using enum SupportKind;
  auto problem = problem_of(geometry::rectangle(0, 0, 3, 0.7), {{simply_supported, {"top"}, {}}}, {});
  problem.cracks = {
      {{2.563, 0.1}, {2.561, 0.55}}};  // blocks meet at 2.56: points on both sides of it see each other not
  problem.foundations = {{2000, 3, geometry::Hole(geometry::Circle{{2.3, 0.3}, 0.45, ""})}};
  Spring edge, line, point;
  edge.edges = {"left", "bottom"}, edge.deflection = 40, edge.rotation_normal = 3;
  line.along = {{1.1, 0.05}, {2.9, 0.63}}, line.deflection = 70, line.rotation_tangential = 2;
  point.position = {2.553, 0.61}, point.deflection = 20, point.rotation = 5;
  problem.springs = {edge, line, point};
  Load along, formula;
  along.kind = Load::Kind::line_load, along.value = 2, along.along = {{0.2, 0.61}, {1.9, 0.2}, {2.9, 0.2}};
  formula.formula = Formula("3 * sin(pi * x) + y^2"), formula.patch = geometry::Circle{{2.5, 0.3}, 0.38, ""};
  problem.loads = {along, formula};
  SECTION("in motion") {
    check(problem);
  }
  SECTION("in single precision") {
    check(problem, true);
  }
  SECTION("at rest") {
    check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0);
    check_rest(problem, StaticMethod::cg, Preconditioning::two_level, 1e-12);
  }
  SECTION("held by soil beneath a part, and a piece that it does not reach") {
    problem.supports.clear(), problem.springs.clear();
    problem.cracks = {{{1.131, -0.1}, {1.249, 0.8}}, {{2.831, -0.1}, {2.831, 0.8}}};
    const auto free = [&] {
      std::vector<int> modes;
      const auto local = own(problem);
      for (const auto& piece : discretise(local).plate->pieces()) modes.push_back(piece.free_modes);
      return modes;
    };
    const auto whole = free();
    CHECK(std::ranges::count(whole, 0) == 1);
    CHECK(std::ranges::count(whole, 3) == 2);
    for (const int processes : {1, 2, 4, 7})
      thread_ranks::run(processes, [&](const Ranks&) {
        const auto shared = free();
        static std::mutex one_by_one;
        const std::lock_guard guard(one_by_one);
        CHECK(shared == whole);
      });
  }
}

TEST_CASE("a plate in parts: an expression whose sum is not known is refused by all, by their sum") {
  auto problem = problem_of(geometry::rectangle(0, 0, 3, 0.7), {{SupportKind::clamped, {"left"}, {}}}, {pressure(0)});
  problem.loads[0].formula = Formula("exp(-((x - 0.3)^2 + (y - 0.3)^2) / 4e-6)");
  CHECK_THROWS_AS(discretise(problem), FormulaError);
  for (const int processes : {1, 4}) {
    int refused = 0;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Ranks&) {
      const auto local = own(problem);
      try {
        discretise(local);
      } catch (const FormulaError&) {
        const std::lock_guard guard(one_by_one);
        ++refused;
      }
    });
    CHECK(refused == processes);
  }
}

TEST_CASE("a plate in parts: one load after the other, each from the best sum of what was found") {
  using enum SupportKind;
  auto problem = problem_of(geometry::rectangle(0, 0, 0.5, 1.2), {{clamped, {"left"}, {}}}, {pressure(2), pressure(0)});
  problem.loads[1].gradient = {0, 3};
  struct Found {
    std::vector<std::size_t> iterations;
    std::map<std::array<long, 2>, std::array<double, 3>> state;
  };
  const auto solved = [&] {
    const auto plate = discretise(problem).plate;
    StaticSolver solver(*plate, StaticMethod::cg, Preconditioning::diagonal);
    const Forces one = plate->loads()[0].forces, other = plate->loads()[1].forces;
    Found found;
    for (const Forces& load : {one, other, Forces(one - 2 * other)}) {
      const auto solution = solver(load, {1e-8, 20000, {}}, true).solution;
      found.iterations.push_back(solution.iterations);
      for (std::uint32_t k = 0; k < plate->cloud().plate_points; ++k)
        if (plate->boundary().owns(k))
          found.state[geometry::cell_of(plate->boundary().lattice[k])] = {solution.state(0, k), solution.state(1, k),
                                                                          solution.state(2, k)};
    }
    return found;
  };
  const auto whole = solved();
  CHECK(whole.iterations[2] < whole.iterations[0] / 10);  // it is a sum of the first two
  Found one;
  for (const int processes : {1, 3, 7}) {
    INFO(processes << " processes");
    Found all;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Ranks&) {
      auto own = solved();
      const std::lock_guard guard(one_by_one);
      all.state.merge(own.state), all.iterations = own.iterations;
    });
    REQUIRE(all.state.size() == whole.state.size());
    if (processes == 1) one = all;
    CHECK(all.iterations == one.iterations);
    CHECK((all.state == one.state));
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(std::abs(double(all.iterations[i]) - double(whole.iterations[i])) <= 0.01 * double(whole.iterations[i]));
    double largest = 0, apart = 0;
    for (const auto& [cell, value] : whole.state)
      for (std::size_t c = 0; c < 3; ++c) {
        largest = std::max(largest, std::abs(value[c]));
        apart = std::max(apart, std::abs(value[c] - all.state.at(cell)[c]));
      }
    CAPTURE(apart / largest);
    CHECK(apart < 1e-6 * largest);
  }
}

TEST_CASE("a plate in parts: pieces that cracks cut off, whoever has them") {
  using enum SupportKind;
  auto problem = problem_of(geometry::rectangle(0, 0, 3, 0.7), {{clamped, {"left", "right"}, {}}}, {pressure(2)});
  problem.cracks = {{{1.131, -0.1}, {1.249, 0.8}}, {{2.831, -0.1}, {2.831, 0.8}}};
  const auto found = [&] {
    std::vector<std::array<double, 3>> result;
    const auto plate = discretise(problem).plate;
    for (const auto& piece : plate->pieces())
      result.push_back({double(piece.points), double(piece.free_modes), piece.position.x()});
    return result;
  };
  const auto whole = found();
  REQUIRE(whole.size() == 3);
  CHECK(whole[0][1] == 3);  // the middle is free, the others are held
  CHECK(whole[1][1] + whole[2][1] == 0);
  for (const int processes : {1, 2, 4, 7})
    thread_ranks::run(processes, [&](const Ranks&) {
      const auto shared = found();
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
  const auto searched = [&] { return discretise(problem).plate->mechanisms(); };
  const bool hinge = searched().motions > 0;
  for (const int processes : {2, 4})
    thread_ranks::run(processes, [&](const Ranks&) {
      const bool seen = searched().searched;
      static std::mutex one_by_one;
      const std::lock_guard guard(one_by_one);
      CHECK(seen == !hinge);
    });
  CHECK(hinge);
}
