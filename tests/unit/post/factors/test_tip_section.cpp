#include "post/factors/tip_section.hpp"

#include <Eigen/LU>
#include <numbers>

#include "tests/catch.hpp"

using plate::Section;
using post::TipSection;

namespace {

Section orthotropic(double E1, double E2, double G12, double angle = 0) {
  Section s{0, 0, 0.1, 5.0 / 6, 0};
  s.orthotropic = {E1, E2, 0.3, G12, 30, 12, angle};
  return s;
}

}  // namespace

TEST_CASE("tip section: an isotropic one, and an orthotropic one that is the same") {
  const Section s{1000, 0.3, 0.1, 5.0 / 6, 0};
  const double bending = 12 * std::numbers::pi / (1000 * 1e-3), shear = std::numbers::pi * 1.3 / (5.0 / 6 * 1000 * 0.1);
  CHECK(TipSection(s).release({2, 3, 0}) == Approx(13 * bending).epsilon(1e-14));
  CHECK(TipSection(s).release({0, 0, 5}) == Approx(25 * shear).epsilon(1e-14));
  Section other = s;
  other.orthotropic = {1000, 1000, 0.3, 1000 / 2.6, 1000 / 2.6, 1000 / 2.6, 0};
  for (const double a : {0.0, 0.4, 2.0})
    CHECK(TipSection(other, {std::cos(a), std::sin(a)}).compliance.isApprox(TipSection(s).compliance, 1e-12));
}

TEST_CASE("tip section: along an axis the closed form of Sih, Paris and Irwin") {
  // G_I = K^2 sqrt(a11 a22 / 2) sqrt(sqrt(a22 / a11) + (2 a12 + a66) / (2 a11)), with a of the plate's bending
  const double E1 = 100, E2 = 20, G12 = 8, nu = 0.3, third = 12 / 1e-3;
  const double a11 = third / E1, a22 = third / E2, a12 = -third * nu / E1, a66 = third / G12;
  const double root = std::sqrt(std::sqrt(a22 / a11) + (2 * a12 + a66) / (2 * a11));
  const TipSection at(orthotropic(E1, E2, G12));
  CHECK(at.release({1, 0, 0}) == Approx(std::numbers::pi * std::sqrt(a11 * a22 / 2) * root).epsilon(1e-12));
  CHECK(at.release({0, 1, 0}) == Approx(std::numbers::pi * a11 / std::sqrt(2.0) * root).epsilon(1e-12));
  CHECK(at.release({0, 0, 1}) == Approx(std::numbers::pi / 2 / (5.0 / 6 * 0.1 * std::sqrt(30.0 * 12))).epsilon(1e-12));
  CHECK(at.compliance(0, 1) == Approx(0).margin(1e-9));
}

TEST_CASE("tip section: one tensor of the material, whichever way the crack runs") {
  // Barnett and Lothe: Lambda does not know the direction ahead
  for (const double angle : {0.0, 25.0, 70.0}) {
    const auto s = orthotropic(140, 10, 5, angle);
    Eigen::Matrix2d first;
    for (const double a : {0.0, 0.3, 1.1, 2.9}) {
      const Eigen::Vector2d ahead(std::cos(a), std::sin(a)), left(-ahead.y(), ahead.x());
      const auto L = TipSection(s, ahead).compliance;
      const Eigen::Matrix2d fixed = L(0, 0) * left * left.transpose() + L(1, 1) * ahead * ahead.transpose() +
                                    L(0, 1) * (left * ahead.transpose() + ahead * left.transpose());
      if (a == 0) first = fixed;
      CHECK(fixed.isApprox(first, 1e-11));
      CHECK(fixed.determinant() > 0);
    }
  }
}
