#include "plate/solve/motion/contact_and_damping.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE(
    "what acts beside the stiffness: damping by the change of its force, also where that of the step before is made "
    "again") {
  DynamicOptions options;
  options.time_step = 0.1, options.stiffness_damping = 0.2;
  options.save = [](const MotionCheckpoint&) {};
  const auto force_of = [](const State& state) { return Forces(-3 * state); };
  const State first = State::Constant(3, 1, 0.5), second = State::Constant(3, 1, 0.7);
  const State velocity = State::Constant(3, 1, 2);
  ContactAndDamping whole(options, first);
  CHECK(whole.damps());
  whole.find(first, velocity, force_of(first), force_of);
  CHECK(whole.viscous(0) == Approx(-0.2 * 3 * 2));  // of the velocity to begin with
  MotionCheckpoint memory;
  whole.save(memory);
  CHECK(memory.earlier == first);
  whole.find(second, velocity, force_of(second), force_of);
  CHECK(whole.viscous(0) == Approx(-0.2 * 3 * 2));
  options.from = &memory;
  ContactAndDamping later(options, second);
  later.find(second, State::Zero(3, 1), force_of(second), force_of);
  CHECK(later.viscous(0) == whole.viscous(0));
  options.stiffness_damping = 0, options.from = nullptr;
  CHECK(!ContactAndDamping(options, first).acts());
}

TEST_CASE("what acts beside the stiffness: a mass that presses, and what it remembers of it") {
  DynamicOptions options;
  options.time_step = 0.1;
  options.impact = Impactor{{{dof(0, 0), 1.0}}, 2, 3, 40};
  const State state = State::Zero(3, 1);
  ContactAndDamping contact_and_damping(options, state);
  CHECK((contact_and_damping.acts() && !contact_and_damping.damps()));
  const Forces none = Forces::Zero(3, 1);
  const auto force_of = [&](const State&) { return none; };
  contact_and_damping.find(state, state, none, force_of);
  CHECK(contact_and_damping.force(0) == 0);
  contact_and_damping.move(0.1);
  contact_and_damping.find(state, state, none, force_of);
  CHECK(contact_and_damping.force(0) == Approx(40 * 0.3));
  MotionCheckpoint memory;
  contact_and_damping.save(memory);
  CHECK(memory.impactor_state.place == Approx(0.3));
  options.from = &memory;
  ContactAndDamping later(options, state);
  later.find(state, state, none, force_of);
  CHECK(later.force(0) == contact_and_damping.force(0));
}
