#include "fracture/growth/tip_advance.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"

using namespace fracture;
using Direction = Growth::Direction;

namespace {
const plate::Section kink_section{1000, 0.3, 0.1, 5.0 / 6, 0};
constexpr double degree = std::numbers::pi / 180;
}  // namespace

TEST_CASE("kink: straight on in mode 1, 70.5 degrees in mode 2, away from the side of K2") {
  for (const auto direction : {Direction::straight, Direction::tangential_moment, Direction::energy_release}) {
    CHECK(kink_angle({1, 0, 0}, direction, kink_section) == 0);
    CHECK(kink_angle({1, 0, 5}, direction, kink_section) == 0);
    CHECK(kink_angle({0, 0, 0}, direction, kink_section) == 0);
  }
  CHECK(kink_angle({1e-12, 1, 0}, Direction::tangential_moment, kink_section) ==
        Approx(-std::acos(1.0 / 3)));  // -70.53 degrees
  CHECK(kink_angle({1, 0.3, 0}, Direction::straight, kink_section) == 0);
  CHECK(kink_angle({1, -0.3, 0}, Direction::tangential_moment, kink_section) ==
        Approx(-kink_angle({1, 0.3, 0}, Direction::tangential_moment, kink_section)));
}

TEST_CASE("kink: where the moment across is largest, the moment along vanishes (Erdogan and Sih 1963)") {
  for (const double K2 : {-2.0, -0.5, -0.01, 0.1, 0.4, 3.0}) {
    const double angle = kink_angle({1, K2, 0.2}, Direction::tangential_moment, kink_section);
    CAPTURE(K2, angle);
    CHECK(angle == Approx(2 * std::atan((1 - std::sqrt(1 + 8 * K2 * K2)) / (4 * K2))).epsilon(1e-6));
    CHECK(std::abs(kinked({1, K2, 0}, angle).K2) < 1e-6);
  }
}

TEST_CASE("kink: a tip that closes on the z > 0 face turns as the same one opening") {
  for (const auto direction : {Direction::tangential_moment, Direction::energy_release})
    CHECK(kink_angle({-1, -0.3, 0.1}, direction, kink_section) ==
          Approx(kink_angle({1, 0.3, -0.1}, direction, kink_section)));
}

TEST_CASE("kink: most energy is released near where K2 vanishes, and a shear force holds the tip straight") {
  const double tangential = kink_angle({1, 0.3, 0}, Direction::tangential_moment, kink_section);
  const double released = kink_angle({1, 0.3, 0}, Direction::energy_release, kink_section);
  CHECK(std::abs(released - tangential) < 3 * degree);
  CHECK(std::abs(kink_angle({1, 0.3, 30}, Direction::energy_release, kink_section)) < std::abs(released));
  for (const double other : {-5.0, -1.0, 1.0, 5.0}) {
    const auto at = kinked({1, 0.3, 0}, released), beside = kinked({1, 0.3, 0}, released + other * degree);
    CHECK(std::hypot(at.K1, at.K2) > std::hypot(beside.K1, beside.K2));
  }
}

TEST_CASE("turn: made where it exceeds its error, left away where it does not, resolved where its direction is known") {
  const auto turn = [](const Factors& K, const Factors& errors) {
    return turn_of(K, errors, Direction::tangential_moment, kink_section);
  };
  const auto sure = turn({1, -0.1, 0}, {0.01, 0.01, 0.5});
  CHECK(sure.angle == kink_angle({1, -0.1, 0}, Direction::tangential_moment, kink_section));
  CHECK(sure.error == Approx(0.02).epsilon(0.2));  // twice the error of K2 / K1
  CHECK(sure.resolved());
  CHECK(turn({1, -0.1, 0}, {0.01, 0.12, 0.5}).angle == 0);
  CHECK(turn({1, -0.1, 0}, {0.01, 0.12, 0.5}).known());
  const auto slight = turn({1, -0.1, 0}, {0.01, 1, 0.5});  // 11 degrees that nothing vouches for
  CHECK(slight.angle == 0);
  CHECK_FALSE(slight.known());
  CHECK(slight.resolved());
  CHECK_FALSE(turn({1, -0.5, 0}, {0.01, 1, 0.5}).resolved());
  CHECK_FALSE(turn({0.02, -0.5, 0}, {0.05, 0.01, 0.5}).resolved());  // the sign of K1 decides, and is not known
  CHECK_FALSE(turn({1, -0.5, 0}, {INFINITY, INFINITY, INFINITY}).resolved());
  const auto straight = turn_of({1, -0.5, 0}, {INFINITY, 1, 1}, Direction::straight, kink_section);
  CHECK((straight.angle == 0 && straight.resolved() && straight.known()));
  // all loads the other way round
  CHECK(turn({-1, 0.1, 0}, {0.01, 0.01, 0.5}).angle == Approx(sure.angle));
  CHECK(turn({-1, 0.1, 0}, {0.01, 0.01, 0.5}).error == Approx(sure.error));
}

TEST_CASE("kink: membrane forces turn a tip as moments do") {
  for (const auto direction : {Direction::tangential_moment, Direction::energy_release})
    for (const double second : {-2.0, -0.3, 0.1, 1.0})
      CHECK(kink_angle({.K1 = 0, .K2 = 0, .K3 = 0, .N1 = 1, .N2 = second}, direction, kink_section) ==
            Approx(kink_angle({1, second, 0}, direction, kink_section)));
  // a crack at 45 degrees to the tension (Erdogan and Sih 1963)
  CHECK(kink_angle({.K1 = 0, .K2 = 0, .K3 = 0, .N1 = 1, .N2 = 1}, Direction::tangential_moment, kink_section) ==
        Approx(-2 * std::atan(0.5)));  // -53.13 degrees
}

TEST_CASE("kink: the face with the larger tension across turns the tip") {
  const double arm = kink_section.thickness / 6;
  const Factors opens_above{.K1 = 0.5 * arm, .K2 = 0.2 * arm, .K3 = 0, .N1 = 1, .N2 = 0};
  const Factors opens_below{.K1 = -0.5 * arm, .K2 = -0.2 * arm, .K3 = 0, .N1 = 1, .N2 = 0};
  CHECK(governing_face(opens_above, kink_section.thickness) == 1);
  CHECK(governing_face(opens_below, kink_section.thickness) == -1);
  CHECK(governing_face({1, 0.3, 0}, kink_section.thickness) == 1);
  CHECK(governing_face({-1, 0.3, 0}, kink_section.thickness) == -1);
  const double angle = kink_angle({1.5, 0.2, 0}, Direction::tangential_moment, kink_section);
  for (const auto& K : {opens_above, opens_below})
    CHECK(kink_angle(K, Direction::tangential_moment, kink_section) == Approx(angle));
  CHECK(pressed({.K1 = 0, .K2 = 1, .K3 = 1, .N1 = -1, .N2 = 1}, kink_section.thickness));
  CHECK(pressed({.K1 = 0.9 * arm, .K2 = 0, .K3 = 0, .N1 = -1, .N2 = 0}, kink_section.thickness));
  CHECK_FALSE(pressed({.K1 = -1.1 * arm, .K2 = 0, .K3 = 0, .N1 = -1, .N2 = 0}, kink_section.thickness));
  CHECK_FALSE(pressed({.K1 = -1, .K2 = 0, .K3 = 0, .N1 = 0, .N2 = 0}, kink_section.thickness));
  CHECK_FALSE(pressed({0, 0, 0}, kink_section.thickness));
}

TEST_CASE("energy release: bending and membrane forces add up, whatever their modes") {
  const double h = kink_section.thickness, pi = std::numbers::pi;
  const double membrane = pi / (kink_section.young * h), bending = 12 * pi / (kink_section.young * h * h * h);
  const double shear = pi * (1 + kink_section.poisson) / (kink_section.shear_correction * kink_section.young * h);
  CHECK(energy_release({2, 3, 5}, kink_section) == Approx(bending * 13 + shear * 25));
  CHECK(energy_release({.K1 = 2, .K2 = 3, .K3 = 5, .N1 = -7, .N2 = 11}, kink_section) ==
        Approx(bending * 13 + shear * 25 + membrane * 170));
}

TEST_CASE("turn: errors of membrane factors count") {
  const auto turn = [](double error) {
    return turn_of({.K1 = 0, .K2 = 0, .K3 = 0, .N1 = 1, .N2 = -0.1},
                   {.K1 = 0, .K2 = 0, .K3 = 0, .N1 = 0.01, .N2 = error}, Direction::tangential_moment, kink_section);
  };
  CHECK(turn(0.01).error == Approx(0.02).epsilon(0.2));  // twice the error of N2 / N1
  CHECK(turn(0.01).angle > 0);
  CHECK(turn(0.12).angle == 0);
  CHECK_FALSE(turn(INFINITY).known());
}

TEST_CASE("release error: that of the factors that hold the energy") {
  CHECK(release_error({2, 0, 0}, {0.1, 9, 9}, kink_section) == Approx(0.05));
  CHECK(release_error({0, -4, 0}, {9, 0.1, 9}, kink_section) == Approx(0.025));
  CHECK(release_error({0, 0, 5}, {9, 9, 0.1}, kink_section) == Approx(0.02));
  const Factors tension{.K1 = 0, .K2 = 0, .K3 = 0, .N1 = 2, .N2 = 0};
  CHECK(release_error(tension, {.K1 = 9, .K2 = 9, .K3 = 9, .N1 = 0.1, .N2 = 9}, kink_section) == Approx(0.05));
  CHECK(std::isinf(release_error({1, 0, 0}, {INFINITY, 0, 0}, kink_section)));
  CHECK(std::isinf(release_error({0, 0, 0}, {1, 1, 1}, kink_section)));
}
