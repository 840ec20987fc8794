// Loads, foundations and springs of plates that processes share.
#include <mutex>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/bonds/parts.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"

using namespace parts;

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
  const Load along{LineLoad{.along = {{0.2, 0.61}, {1.9, 0.2}, {2.9, 0.2}}, .value = 2}};
  const Load formula{
      Pressure{.formula = Formula("3 * sin(pi * x) + y^2"), .patch = geometry::Circle{{2.5, 0.3}, 0.38, ""}}};
  problem.loads = {along, formula};
  SECTION("in motion") {
    check(problem);
  }
  SECTION("in single precision") {
    check(problem, {true});
  }
  SECTION("at rest") {
    check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0);
    check_rest(problem, StaticMethod::cg, Preconditioning::two_level, 1e-12);
  }
  SECTION("held by soil beneath a part, and a piece that it does not reach") {
    problem.supports.clear(), problem.springs.clear();
    problem.cracks = {{{1.131, -0.1}, {1.249, 0.8}}, {{2.831, -0.1}, {2.831, 0.8}}};
    const auto free = [&](const Communicator& all) {
      std::vector<int> modes;
      const auto local = own(problem);
      const auto plate = discretise(local, all).plate;
      for (const auto& piece : plate->pieces()) modes.push_back(piece.free_modes);
      return modes;
    };
    const auto whole = free(single_process());
    CHECK(std::ranges::count(whole, 0) == 1);
    CHECK(std::ranges::count(whole, 3) == 2);
    for (const int processes : {1, 2, 4, 7})
      thread_ranks::run(processes, [&](const Communicator& all) {
        const auto shared = free(all);
        static std::mutex one_by_one;
        const std::lock_guard guard(one_by_one);
        CHECK(shared == whole);
      });
  }
}

TEST_CASE("a plate in parts: a temperature and a fluid up to a level") {
  using enum SupportKind;
  auto problem =
      problem_of(geometry::rectangle(0, 0, 3, 0.7), {{clamped, {"left"}, {}}, {simply_supported, {"top"}, {}}}, {});
  problem.section.thermal_expansion = 0.01;
  problem.cracks = {{{2.4, 0.1}, {2.7, 0.5}}};
  const Load fluid{Pressure{.value = 3, .level = 0.43}};
  const Load heat{Temperature{.formula = Formula("20 + 10 * x * y")}};
  problem.loads = {fluid, heat};
  SECTION("in motion") {
    check(problem);
  }
  SECTION("at rest") {
    check_rest(problem, StaticMethod::cg, Preconditioning::diagonal, 0);
  }
  SECTION("the energy that is stored") {
    const auto energy = [&](const Communicator& all) {
      const auto local = own(problem);
      const auto plate = discretise(local, all).plate;
      State state = State::Zero(3, Eigen::Index(plate->points()));
      for (std::uint32_t k = 0; k < plate->cloud().plate_points; ++k) {
        const auto& x = plate->cloud().positions[k];
        state.col(k) << x.x() * x.x(), x.y(), std::sin(x.x());
      }
      plate->constraints().impose(state);
      return stored(*plate, heat_of(*plate, 1), state);
    };
    const double whole = energy(single_process());
    std::vector<double> found;
    for (const int processes : {1, 2, 5})
      thread_ranks::run(processes, [&](const Communicator& all) {
        const double one = energy(all);
        static std::mutex one_by_one;
        const std::lock_guard guard(one_by_one);
        found.push_back(one);
      });
    CHECK(std::ranges::count(found, found.front()) == 8);
    CHECK(found.front() == Approx(whole).epsilon(1e-12));
  }
}

TEST_CASE("a plate in parts: an expression whose sum is not known is refused by all, by their sum") {
  auto problem = problem_of(geometry::rectangle(0, 0, 3, 0.7), {{SupportKind::clamped, {"left"}, {}}}, {pressure(0)});
  problem.loads[0].as<Pressure>()->formula = Formula("sin(1e9 * x * y) > 0 ? 1 : 0");
  CHECK_THROWS_AS(discretise(problem), Refused);
  for (const int processes : {1, 4}) {
    int refused = 0;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Communicator& all) {
      const auto local = own(problem);
      try {
        discretise(local, all);
      } catch (const Refused&) {
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
  problem.loads[1].as<Pressure>()->gradient = {0, 3};
  struct Found {
    std::vector<std::size_t> iterations;
    std::map<std::array<long, 2>, std::array<double, 3>> state;
  };
  const auto solved = [&](const Communicator& communicator) {
    const auto plate = discretise(problem, communicator).plate;
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
  const auto whole = solved(single_process());
  CHECK(whole.iterations[2] < whole.iterations[0] / 10);  // it is a sum of the first two
  Found one;
  for (const int processes : {1, 3, 7}) {
    INFO(processes << " processes");
    Found all;
    std::mutex one_by_one;
    thread_ranks::run(processes, [&](const Communicator& communicator) {
      auto own = solved(communicator);
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
