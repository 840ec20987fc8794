#include "plate/solve/motion/masses_and_loads.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("masses: the work of loads from rest, from where they have grown to, and from where something else has led") {
  Constraints constraints;
  constraints.resolve();
  const Forces mass = Forces::Ones(3, 4);
  Forces load = Forces::Zero(3, 4);
  load(0, 2) = 5;
  State first = State::Zero(3, 4), then = first;
  first(0, 2) = 0.3, then(0, 2) = 1.1;
  const auto masses = [&] { return Masses(mass, {{load, {}}}, constraints); };
  auto rests = masses();
  CHECK(rests.work(1, then) == Approx(5.5));
  auto grown = masses();
  grown.start(first);
  CHECK(grown.work(0, first) == Approx(0.75));
  CHECK(grown.work(1, then) == Approx(0.75 + 4));
  auto led = masses();
  led.bent(first), led.give(2);
  CHECK(led.work(0, first) == Approx(2));
  CHECK(led.work(1, then) == Approx(2 + 4));
  MotionCheckpoint memory;
  led.save(memory);
  auto again = masses();
  again.restore(memory);
  CHECK(again.work(1, then) == led.work(1, then));
  CHECK_FALSE(led.varies());
}
