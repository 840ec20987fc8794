#include "plate/galerkin/galerkin_plate.hpp"

#include "plate/formulation/discretised.hpp"
#include "plate/formulations.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

TEST_CASE(
    "Galerkin plate: a small round hole is warned of where it holds the plate, and not where its points are many") {
  plate::Problem problem;
  problem.section = {1000, 0.3, 0.1, 5.0 / 6, 2};
  problem.outline = geometry::rectangle(-1, -1, 1, 1);
  problem.outline.holes = {geometry::Circle{{0.07, -0.03}, 0.18, "hole0"}};
  problem.discretization.formulation = plate::formulations().front();
  REQUIRE_FALSE(problem.discretization.formulation->offers(plate::Feature::horizon));
  const auto warnings = [&](double spacing, const char* held) {
    problem.discretization.spacing = spacing;
    problem.supports = {{plate::SupportKind::simply_supported, {held}, {}}};
    return plate::discretise(problem).plate->warnings(false);
  };
  CHECK(warnings(0.1, "left").empty());
  CHECK(warnings(0.08, "hole0").empty());
  REQUIRE(warnings(0.1, "hole0").size() == 1);
  CHECK_THAT(warnings(0.1, "hole0")[0], Catch::Contains("hole0") && Catch::Contains("`hole_spacing` = 0.045"));
}
