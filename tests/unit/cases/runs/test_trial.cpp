#include "cases/driver/accuracy.hpp"

#include "plate/formulation/discretised.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/plate_factors.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("trial: the factors at rest and the plate's solution, or when it was not found") {
  auto c = read(plain + "[srif]\naccuracy = 0.1\n").content;
  c.discretization.spacing = 0.1, c.discretization.tip_spacing.reset(), c.discretization.hole_spacing.reset();
  cases::ValidatedPlate ready;
  ready.plate = plate::discretise(c).plate;
  ready.tip_methods = post::tip_methods(*ready.plate, *c.srif);
  const auto trial = cases::trial(ready, c.analysis, *c.srif);
  REQUIRE(ready.solution);
  REQUIRE(trial.rows.size() == 1);
  CHECK(trial.rows[0].front().K1 != 0);
  CHECK(trial.strain_energy == Approx(ready.plate->strain_energy(ready.solution->solution.state)));
  c.analysis.max_iterations = 1;
  c.analysis.preconditioner = plate::Preconditioning::diagonal;
  CHECK_THROWS_WITH(
      cases::factors_at_rest(*ready.plate, ready.tip_methods, c.analysis, *c.srif, "with twice the spacing"),
      Catch::StartsWith("with twice the spacing: "));
}
