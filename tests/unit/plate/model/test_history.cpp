#include "plate/model/loads.hpp"

#include <cmath>

#include "tests/catch.hpp"

using plate::factor;
using plate::History;

TEST_CASE("step: 1 from the start") {
  const History step;
  CHECK(step.constant());
  CHECK(factor(step, 0) == 1);
  CHECK(factor(step, 1e9) == 1);
}

TEST_CASE("ramp: linear, then 1") {
  const History ramp{History::Kind::ramp, 4, 0, {}};
  CHECK_FALSE(ramp.constant());
  CHECK(factor(ramp, 0) == 0);
  CHECK(factor(ramp, 1) == 0.25);
  CHECK(factor(ramp, 4) == 1);
  CHECK(factor(ramp, 5) == 1);
}

TEST_CASE("ramp in no time: a step") {
  const History ramp{History::Kind::ramp, 0, 0, {}};
  CHECK(factor(ramp, 0) == 1);
  CHECK(factor(ramp, 1) == 1);
}

TEST_CASE("sine: frequency in cycles per time") {
  const History sine{History::Kind::sine, 0, 0.5, {}};  // period 2
  CHECK_FALSE(sine.constant());
  CHECK(factor(sine, 0) == 0);
  CHECK(factor(sine, 0.5) == Approx(1));
  CHECK(factor(sine, 1.5) == Approx(-1));
  CHECK(std::abs(factor(sine, 2)) < 1e-15);  // measured: 2e-16
  CHECK(factor(sine, 1.0 / 6) == Approx(0.5));
}

TEST_CASE("table: linear between entries, constant beyond them") {
  const History table{History::Kind::table, 0, 0, {{1, 10}, {2, 20}, {4, -20}}};
  CHECK_FALSE(table.constant());
  CHECK(factor(table, 0) == 10);
  CHECK(factor(table, 1) == 10);
  CHECK(factor(table, 1.25) == 12.5);
  CHECK(factor(table, 2) == 20);
  CHECK(factor(table, 3) == 0);
  CHECK(factor(table, 4) == -20);
  CHECK(factor(table, 9) == -20);
}

TEST_CASE("table: two entries at one time are a jump to the later one") {
  const History jump{History::Kind::table, 0, 0, {{0, 0}, {1, 0}, {1, 5}, {2, 5}}};
  CHECK(factor(jump, std::nextafter(1.0, 0.0)) == 0);
  CHECK(factor(jump, 1) == 5);
  CHECK(factor(jump, 2) == 5);
}
