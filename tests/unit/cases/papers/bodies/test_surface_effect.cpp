#include "cases/papers/bodies/surface_effect.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("surface effect: the parts of the tables meet at one and at two horizons") {
  for (const auto f : {bb::weighted_volume_near_end, bb::flux_near_end})
    CHECK(f(1 - 1e-9) == Approx(f(1)).epsilon(1e-8));
  CHECK(bb::flux_near_end(2) == Approx(1).epsilon(1e-12));
  CHECK(std::abs(bb::load_near_end(2)) < 1e-12);
}

TEST_CASE("surface effect: the load is minus the slope of the flux, by finite differences") {
  for (const double x : {0.2, 0.6, 0.95, 1.3, 1.8}) {
    const double slope = (bb::flux_near_end(x + 1e-5) - bb::flux_near_end(x - 1e-5)) / 2e-5;
    CHECK(bb::load_near_end(x) == Approx(-slope).epsilon(1e-6).margin(1e-8));
  }
}

TEST_CASE("surface effect: place_of finds where a function passes a level") {
  CHECK(bb::place_of([](double x) { return x * x; }, 2, 0, 2) == Approx(std::sqrt(2.0)).epsilon(1e-11));
}
