#include "plate/model/process.hpp"

#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "tests/catch.hpp"

TEST_CASE("a plate of more points than the memory holds is refused at once, by either formulation") {
  REQUIRE(plate::free_memory() > 1e6);
  for (const auto* kind : {&plate::ordinary, &plate::galerkin})
    for (const double spacing : {1e-7, 1e-12, 1e-160}) {
      plate::Problem problem;
      problem.section = {1000, 0.3, 0.1, 5.0 / 6, 1};
      problem.outline = geometry::rectangle(0, 0, 1, 1);
      problem.discretization.spacing = spacing;
      problem.discretization.formulation = kind;
      CHECK_THROWS_AS(plate::discretise(problem), plate::Refused);
    }
}
