#include "cases/papers/bodies/fractions.hpp"

#include "tests/catch.hpp"

namespace bb = boundary_bodies;

TEST_CASE("fractions: families fill the interval, the disc and the ball, without the node's own cell") {
  constexpr double pi = std::numbers::pi;
  for (const double ratio : {2.0, 3.0, 3.015}) {
    const double whole[] = {2 * ratio, pi * ratio * ratio, 4 * pi / 3 * ratio * ratio * ratio};
    for (const int dimension : {1, 2, 3}) {
      double sum = 1;
      for (const auto& neighbour : bb::family_of(dimension, ratio)) sum += neighbour.fraction;
      CHECK(sum == Approx(whole[dimension - 1]).epsilon(1e-9));
    }
  }
}

TEST_CASE("fractions: a quarter of a disc, an eighth of a ball, fitted shares have the moduli of the continuum") {
  CHECK(bb::area_in_disc(2, {0, 0}, {5, 5}) == Approx(std::numbers::pi));
  CHECK(bb::volume_in_ball(2, {0, 0, 0}, {5, 5, 5}) == Approx(4 * std::numbers::pi / 3));
  const auto family = bb::fitted(bb::family_of(2, 3), 3, bb::gauss);
  CHECK(bb::mean_of_directions(family, 3, bb::gauss, 4, 0) == Approx(3.0 / 8).epsilon(1e-12));
  CHECK(bb::mean_of_directions(family, 3, bb::gauss, 2, 2) == Approx(1.0 / 8).epsilon(1e-12));
}
