#include "plate/model/nodal_forces.hpp"

#include <limits>

#include "plate/model/membrane.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("a temperature bends freely by alpha dT / h, at every point by its expression") {
  const Section section{1000, 0.3, 0.2, 5.0 / 6, 1, 4e-3};
  const std::vector<geometry::Point> places{{0, 0}, {1, 2}, {3, -1}};
  CHECK(free_curvature(Load{Pressure{.value = 10}}, section, places, 3).size() == 0);
  Load load{Temperature{.value = 10}};
  const auto uniform = free_curvature(load, section, places, 2);
  REQUIRE(uniform.size() == 2);
  CHECK(uniform[1] == Approx(0.2));
  load.action = Temperature{.formula = Formula("10 * x - y")};
  const auto varying = free_curvature(load, section, places, 3);
  CHECK(varying[2] == Approx(0.02 * 31));
  load.action = Temperature{.formula = Formula("1 / (x - 1)")};
  CHECK_THROWS_AS(free_curvature(load, section, places, 2), FormulaError);
}

TEST_CASE("a mean temperature stretches the plate in its plane by alpha T, and does not bend it") {
  Problem problem;
  problem.section = {1000, 0.3, 0.2, 5.0 / 6, 1, 4e-3};
  problem.loads = {{Temperature{.value = 10}},
                   {Temperature{.mean = 5}},
                   {Temperature{.value = 10, .mean = -5}},
                   {Temperature{.mean_formula = Formula("x + y")}}};
  const std::vector<geometry::Point> places{{0, 0}, {1, 2}};
  const auto at_second = [&](const Problem& one, std::size_t i) {
    const auto found = free_curvature(one.loads[i], one.section, places, 2);
    return found.size() == 2 ? found[1] : 0.0;
  };
  const auto membrane = membrane_of(problem);
  const std::vector<double> curvatures{0.2, 0, 0.2, 0}, strains{0, 0.02, -0.02, 0.012};
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    CAPTURE(i);
    CHECK(problem.loads[i].in_plane() == (i > 0));
    CHECK(at_second(problem, i) == Approx(curvatures[i]));
    CHECK(at_second(membrane, i) == Approx(strains[i]));
  }
  CHECK(free_curvature(problem.loads[1], problem.section, places, 2).size() == 0);  // off means absent
  CHECK(free_curvature(membrane.loads[0], membrane.section, places, 2).size() == 0);
  scale(problem.loads[3], 2), scale(problem.loads[2], 2);
  CHECK(problem.loads[3].as<Temperature>()->mean_formula(places[1]) == Approx(6));
  CHECK(problem.loads[2].as<Temperature>()->mean == -10);
}

TEST_CASE("a problem is heated where one of its loads is a temperature") {
  Problem problem;
  problem.loads.resize(2);
  CHECK_FALSE(heated(problem));
  problem.loads[1].action = Temperature{};
  CHECK(heated(problem));
}
