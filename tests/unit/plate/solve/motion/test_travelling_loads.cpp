#include "plate/solve/motion/masses_and_loads.hpp"

#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("loads that move do the work of their forces, and go on as they were") {
  MovingForces forces;
  forces.stations = {{0, {{dof(1, 0), 2.0}}}, {1, {{dof(2, 0), 2.0}}}};  // from point 1 to point 2
  std::vector<TimedLoad> loads(1);
  loads[0].moving = std::make_shared<MovingForces>(forces);
  const Constraints constraints;
  TravellingLoads load(loads, constraints), other;
  CHECK(!other.any());
  const double dt = 0.01;
  Forces force;
  TravellingLoads later;
  for (int n = 0; n <= 100; ++n) {  // w grows with time: 1 at point 1, 3 at point 2
    const double time = n * dt;
    State state = State::Zero(3, 3);
    state(0, 1) = time, state(0, 2) = 3 * time;
    force = Forces::Zero(3, 3);
    load.add(time, dt, state, force);
    if (n == 50) {
      later = TravellingLoads(loads, constraints);
      later.restore(load.memory());
    } else if (n > 50) {
      Forces again = Forces::Zero(3, 3);
      later.add(time, dt, state, again);
    }
    CHECK(force(0, 1) == Approx(2 * (1 - time)).margin(1e-12));
    CHECK(force(0, 2) == Approx(2 * time).margin(1e-12));
  }
  State state = State::Zero(3, 3);
  Instant seen{100, 1, state, {}, 0, 0, 0};
  load.complete(seen);
  CHECK(seen.external_work == Approx(4));  // 2 (1 - t) 1 + 2 t 3 over a unit of time
  Instant again{100, 1, state, {}, 0, 0, 0};
  later.complete(again);
  CHECK(again.external_work == seen.external_work);
}

TEST_CASE("loads that move leave at the end of their path, in their work as in their forces, whatever rounding does") {
  const double dt = 0.01;
  for (int last = 2; last < 60; ++last) {
    MovingForces forces;
    forces.stations = {{0, {{dof(1, 0), 2.0}}}, {last * dt, {{dof(1, 0), 2.0}}}};  // on point 1
    std::vector<TimedLoad> loads(1);
    loads[0].moving = std::make_shared<MovingForces>(forces);
    const Constraints constraints;
    TravellingLoads load(loads, constraints);
    State state = State::Zero(3, 2);
    for (int n = 0; n <= last + 2; ++n) {
      state(0, 1) = n * dt;
      Forces force = Forces::Zero(3, 2);
      load.add(n * dt, dt, state, force);
      CHECK(force(0, 1) == (n <= last ? 2 : 0));
    }
    Instant seen{std::size_t(last + 2), (last + 2) * dt, state, {}, 0, 0, 0};
    load.complete(seen);
    INFO(last);
    CHECK(seen.external_work == Approx(2 * (last + 0.5) * dt));  // the last step has the mean of 2 and 0
  }
}
