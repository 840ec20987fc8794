#include "plate/solve/validation.hpp"

#include <limits>

#include "plate/formulation/constraints.hpp"
#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("finite: the first point and its first component that are not, with when it was") {
  State state = State::Constant(3, 1000, std::numeric_limits<double>::max());
  CHECK_NOTHROW(require_finite(state, "in equilibrium"));
  CHECK_NOTHROW(require_finite(State(3, 0), "without points"));
  CHECK_NOTHROW(require_finite(state, "in equilibrium", Constraints()));
  state(2, 700) = std::numeric_limits<double>::infinity();
  state(1, 700) = -std::numeric_limits<double>::infinity();
  state(0, 900) = std::numeric_limits<double>::quiet_NaN();
  try {
    require_finite(state, "at step 7");
    FAIL("it was let through");
  } catch (const NumericalError& error) {
    CHECK(std::string(error.what()) == "theta_x of point 700 is not finite at step 7");
    CHECK(error.point == std::size_t(700));
  }
}
