#include "plate/model/nodal_forces.hpp"

#include <limits>

#include "plate/model/problem.hpp"
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

TEST_CASE("a problem is heated where one of its loads is a temperature") {
  Problem problem;
  problem.loads.resize(2);
  CHECK_FALSE(heated(problem));
  problem.loads[1].action = Temperature{};
  CHECK(heated(problem));
}
