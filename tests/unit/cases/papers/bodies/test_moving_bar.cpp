#include "cases/papers/bodies/moving_bar.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("moving bar: before the wave meets an end all ways have the same motion, with multipliers held") {
  const auto bare = bb::moving_bar({.ends = bb::BarEnds::bare}, {50, 100});
  const auto surface = bb::moving_bar({.ends = bb::BarEnds::surface}, {50, 100});
  const auto multiplied = bb::moving_bar({.ends = bb::BarEnds::multiplied}, {50, 100});
  REQUIRE(surface.size() == 2);
  for (std::size_t i : {0, 1}) {
    CHECK((bare[i].u - surface[i].u).cwiseAbs().maxCoeff() < 1e-7);
    CHECK((multiplied[i].u - surface[i].u).cwiseAbs().maxCoeff() < 1e-7);
    CHECK(multiplied[i].violated < 1e-12);
    CHECK(surface[i].mean < 0.01);
    CHECK(surface[i].largest > 0);
  }
}
