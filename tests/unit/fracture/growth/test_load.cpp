#include "fracture/growth/record.hpp"
#include "tests/catch.hpp"

using namespace fracture;
using Control = Growth::Control;

namespace {

constexpr double never = INFINITY;

}  // namespace

TEST_CASE("load: up to the next change as far as the control lets it, and what is beyond") {
  QuasiStaticLoad load(Control::load);
  auto step = load.to(2, 0.25);  // the whole load would move by 2
  CHECK(step.stable);
  CHECK_FALSE(step.beyond);
  CHECK(load.factor() == 0.25);
  CHECK(load.displacement() == 0.5);
  step = load.to(3, 0.2);  // the load that is there is more than enough: it stays
  CHECK_FALSE(step.stable);
  CHECK(load.factor() == 0.25);
  step = load.to(4, 0.5);
  CHECK(step.stable);
  CHECK(load.factor() == 0.5);
  step = load.to(5, never);
  CHECK(step.beyond);
  CHECK(load.factor() == 1);
  CHECK(load.displacement() == 5);
}

TEST_CASE("load: what is wanted first is stable, however little it needs") {
  for (const auto control : {Control::load, Control::displacement, Control::equilibrium}) {
    QuasiStaticLoad load(control);
    const auto step = load.to(2, 1e-9);
    CHECK(step.stable);
    CHECK_FALSE(step.beyond);
    CHECK(load.factor() == Approx(1e-9));
  }
}

TEST_CASE("load: by displacements the load falls with the stiffness, and ends where the whole one would have begun") {
  QuasiStaticLoad load(Control::displacement);
  load.to(2, 0.5);
  CHECK(load.displacement() == 1);
  auto step = load.to(4, 0.2);  // at displacement 1 the factor is 0.25
  CHECK_FALSE(step.stable);
  CHECK(load.displacement() == 1);
  CHECK(load.factor() == 0.25);
  step = load.to(4, 0.4);
  CHECK(step.stable);
  CHECK(load.displacement() == Approx(1.6));
  step = load.to(8, 0.9);  // displacement 7.2 is more than 2, that of the whole load before any growth
  CHECK(step.beyond);
  CHECK(load.displacement() == Approx(2));
}

TEST_CASE("load: one that follows the crack may fall, and is never beyond") {
  QuasiStaticLoad load(Control::equilibrium);
  load.to(1, 3);
  CHECK(load.factor() == 3);
  const auto step = load.to(2, 0.5);
  CHECK_FALSE(step.stable);
  CHECK_FALSE(step.beyond);
  CHECK(load.factor() == 0.5);
  CHECK_FALSE(load.to(3, never).beyond);
  CHECK(load.factor() == 0.5);
}

TEST_CASE("load: the work is the area under the load over the displacement, the strain energy that of the last line") {
  // by hand, triangles and rectangles: (displacement, factor) at the corners
  QuasiStaticLoad dead(Control::load);
  dead.to(2, 0.25), dead.to(3, 0.2), dead.to(4, 0.5);  // (0.5, .25) (0.75, .25) (1, .25) (2, .5)
  CHECK(dead.ledger.external_work == Approx(0.0625 + 0.125 + 0.375));
  CHECK(dead.ledger.strain == Approx(0.5));
  QuasiStaticLoad fixed(Control::displacement);
  fixed.to(2, 0.5), fixed.to(4, 0.2), fixed.to(4, 0.4);  // (1, .5) (1, .25) (1.6, .4)
  CHECK(fixed.ledger.external_work == Approx(0.25 + 0.195));
  CHECK(fixed.ledger.strain == Approx(0.32));
  QuasiStaticLoad follows(Control::equilibrium);
  follows.to(1, 3), follows.to(8, 0.5);  // (3, 3) (4, 0.5)
  CHECK(follows.ledger.external_work == Approx(4.5 + 1.75));
  CHECK(follows.ledger.strain == Approx(1));
  follows.ledger.fracture = 5;
  CHECK(follows.ledger.released() == Approx(0.25));
}

TEST_CASE("load: supports that have moved do no work while something gives way") {
  QuasiStaticLoad load(Control::load);
  load.to(2, 0.5, 2);  // of supports alone
  CHECK(load.ledger.external_work == 0.25);
  CHECK(load.ledger.strain == 0.25);
  load.to(1.5, 1, 1.5);  // the plate has become more compliant; then to the whole load
  CHECK(load.ledger.external_work == Approx(0.25 + (1 - 0.5 * 0.5) * 1.5 / 2));
  CHECK(load.ledger.strain == 0.75);

  QuasiStaticLoad both(Control::load);
  both.to(3, 0.5, 1);
  const double before = both.ledger.external_work;
  both.to(3.5, 0.4, 0.5);  // at the same load: what loads work on has gone from 2 to 3
  CHECK(both.ledger.external_work - before == Approx(0.5 * 0.5 * (3 - 2)));
}
