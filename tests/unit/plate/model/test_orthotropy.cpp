#include "plate/model/section.hpp"

#include <cmath>

#include "tests/catch.hpp"

using plate::Orthotropy;

namespace {

const Orthotropy carbon{140, 10, 0.3, 5, 4, 3, 0};

Orthotropy at(double angle) {
  auto result = carbon;
  result.angle = angle;
  return result;
}

}  // namespace

TEST_CASE("orthotropy: along its axes the textbook's stiffness, exactly exchanged at a right angle") {
  const double rest = 1 - 0.09 * 10 / 140;
  const auto Q = plane_stress(carbon);
  CHECK(Q(0, 0) == Approx(140 / rest).epsilon(1e-14));
  CHECK(Q(1, 1) == Approx(10 / rest).epsilon(1e-14));
  CHECK(Q(0, 1) == Approx(0.3 * 10 / rest).epsilon(1e-14));
  CHECK(Q(2, 2) == 5);
  for (const double angle : {90.0, -90.0, 270.0}) {
    const auto turned = plane_stress(at(angle));
    CHECK(turned(0, 0) == Q(1, 1));
    CHECK(turned(1, 1) == Q(0, 0));
    CHECK(turned(0, 2) == 0);
    CHECK(transverse_shear(at(angle)).isApprox(Eigen::Vector2d(3, 4).asDiagonal().toDenseMatrix(), 1e-15));
  }
  CHECK((plane_stress(at(180)) - Q).isZero(0));
}

TEST_CASE("orthotropy: turned by any angle it stores the energy of the strains turned back") {
  for (const double degrees : {17.0, 30.0, 123.0, -250.0}) {
    const double a = degrees * std::acos(-1.0) / 180, c = std::cos(a), s = std::sin(a);
    Eigen::Matrix2d turn, strain;
    turn << c, s, -s, c;
    strain << 0.3, 0.7, 0.7, -1.1;
    const Eigen::Matrix2d own = turn * strain * turn.transpose();
    const auto energy = [](const Eigen::Matrix3d& Q, const Eigen::Matrix2d& e) {
      const Eigen::Vector3d v(e(0, 0), e(1, 1), 2 * e(0, 1));
      return v.dot(Q * v);
    };
    CHECK(energy(plane_stress(at(degrees)), strain) == Approx(energy(plane_stress(carbon), own)).epsilon(1e-13));
    const Eigen::Vector2d gamma(0.4, -0.9), own_gamma = turn * gamma;
    CHECK(gamma.dot(transverse_shear(at(degrees)) * gamma) ==
          Approx(4 * own_gamma.x() * own_gamma.x() + 3 * own_gamma.y() * own_gamma.y()).epsilon(1e-13));
  }
}

TEST_CASE("orthotropy: stable where Poisson's ratio is below the root of the moduli's ratio") {
  auto m = carbon;
  CHECK(m.stable());
  m.nu12 = std::sqrt(14.0) - 1e-9;
  CHECK(m.stable());
  m.nu12 = -std::sqrt(14.0);
  CHECK_FALSE(m.stable());
}
