#include "fracture/growth/kink.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fracture;
using Direction = Growth::Direction;

namespace {
const plate::Section section{1000, 0.3, 0.1, 5.0 / 6, 0};
constexpr double degree = std::numbers::pi / 180;
}  // namespace

TEST_CASE("kink: straight on in mode 1, 70.5 degrees in mode 2, away from the side of K2") {
  for (const auto direction : {Direction::straight, Direction::tangential_moment, Direction::energy_release}) {
    CHECK(kink_angle({1, 0, 0}, direction, section) == 0);
    CHECK(kink_angle({1, 0, 5}, direction, section) == 0);
    CHECK(kink_angle({0, 0, 0}, direction, section) == 0);
  }
  CHECK(kink_angle({1e-12, 1, 0}, Direction::tangential_moment, section) ==
        Approx(-std::acos(1.0 / 3)));  // -70.53 degrees
  CHECK(kink_angle({1, 0.3, 0}, Direction::straight, section) == 0);
  CHECK(kink_angle({1, -0.3, 0}, Direction::tangential_moment, section) ==
        Approx(-kink_angle({1, 0.3, 0}, Direction::tangential_moment, section)));
}

TEST_CASE("kink: where the moment across is largest, the moment along vanishes (Erdogan and Sih 1963)") {
  for (const double K2 : {-2.0, -0.5, -0.01, 0.1, 0.4, 3.0}) {
    const double angle = kink_angle({1, K2, 0.2}, Direction::tangential_moment, section);
    CAPTURE(K2, angle);
    CHECK(angle == Approx(2 * std::atan((1 - std::sqrt(1 + 8 * K2 * K2)) / (4 * K2))).epsilon(1e-6));
    CHECK(std::abs(kinked({1, K2, 0}, angle).K2) < 1e-6);
  }
}

TEST_CASE("kink: a tip that closes on the z > 0 face turns as the same one opening") {
  for (const auto direction : {Direction::tangential_moment, Direction::energy_release})
    CHECK(kink_angle({-1, -0.3, 0.1}, direction, section) == Approx(kink_angle({1, 0.3, -0.1}, direction, section)));
}

TEST_CASE("kink: most energy is released near where K2 vanishes, and a shear force holds the tip straight") {
  const double tangential = kink_angle({1, 0.3, 0}, Direction::tangential_moment, section);
  const double released = kink_angle({1, 0.3, 0}, Direction::energy_release, section);
  CHECK(std::abs(released - tangential) < 3 * degree);
  CHECK(std::abs(kink_angle({1, 0.3, 30}, Direction::energy_release, section)) < std::abs(released));
  for (const double other : {-5.0, -1.0, 1.0, 5.0}) {
    const auto at = kinked({1, 0.3, 0}, released), beside = kinked({1, 0.3, 0}, released + other * degree);
    CHECK(std::hypot(at.K1, at.K2) > std::hypot(beside.K1, beside.K2));
  }
}
