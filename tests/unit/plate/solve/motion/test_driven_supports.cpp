#include "plate/solve/motion/driven_supports.hpp"

#include "plate/formulation/constraints.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/contact_and_damping.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("without settlements nothing is driven, with them what is held is where its history puts it") {
  Constraints constraints;
  constraints.fix(dof(0, 0), {{1, 0.5}});
  constraints.tie(dof(1, 0), {{dof(2, 0), 2}}, {{1, -1}});
  constraints.resolve();
  std::vector<TimedLoad> loads(2);
  for (auto& load : loads) load.forces = Forces::Zero(3, 3);
  const Forces mass = Forces::Ones(3, 3);
  CHECK(!DrivenSupports(loads, constraints, mass, mass).any());
  loads[1].lift = constraints.lift(1, 3);
  loads[1].history.kind = History::Kind::table, loads[1].history.table = {{0, 0}, {1, 1}};
  DrivenSupports driven(loads, constraints, mass, mass);
  REQUIRE(driven.any());
  driven.at(0.5, 0.125, false);
  State state = State::Zero(3, 3);
  driven.place_next(state);
  CHECK(state(0, 0) == Approx(0.3125));
  CHECK(state(0, 1) == Approx(-0.625));
  CHECK(state(0, 2) == 0);
  Forces force = Forces::Constant(3, 3, 2);
  driven.take(force, ContactAndDamping({}, state));  // no acceleration
  CHECK(force == Forces::Constant(3, 3, 2));
  DynamicOptions damped;
  damped.mass_damping = 10;
  driven.take(force, ContactAndDamping(damped, state));  // the speed is that of the history
  CHECK(force(0, 0) == Approx(2 - 10 * 0.5));
  CHECK(force(0, 1) == Approx(2 + 10 * 1));
  const auto memory = driven.memory();
  DrivenSupports other(loads, constraints, mass, mass);
  other.restore(memory);
  CHECK(other.memory() == memory);
}
