#include "cases/papers/bodies/bars.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("bars: local solutions begin at 0, their strain at the end is that of the force there") {
  for (const auto& problem : bb::bar_problems()) {
    CHECK(std::abs(problem.local(0)) < 1e-18);
    const double strain = (problem.local(1) - problem.local(1 - 1e-6)) / 1e-6;
    CHECK(strain == Approx(problem.end_force / (1e9 * 0.01)).margin(2e-9));
  }
}

TEST_CASE("bars: exact from the degree of the solution on, not below") {
  const auto uniform = bb::bar_problems()[1];
  REQUIRE(uniform.degree == 2);
  CHECK(bb::bar_errors(bb::bar_with_multipliers(uniform, 2).u, uniform).maxCoeff() < 1e-10);
  CHECK(bb::bar_errors(bb::bar_with_multipliers(uniform, 1).u, uniform).maxCoeff() > 3);
  CHECK(bb::bar_errors(bb::bar_with_surface_nodes(uniform, 2).u, uniform).maxCoeff() < 1e-10);
  CHECK(bb::bar_errors(bb::uncorrected_bar(uniform).u, uniform).maxCoeff() > 20);
}
