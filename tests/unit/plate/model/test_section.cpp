#include "plate/model/section.hpp"

#include <catch2/catch.hpp>

using plate::Section;

TEST_CASE("bending stiffness is the moment of the stresses of a unit curvature") {
  const Section s{200e9, 0.3, 0.1, 5.0 / 6, 7850};
  // sigma_xx = E/(1-nu^2) z with the strain across prevented; Simpson's rule is exact for z sigma
  const auto moment = [&](double z) { return z * s.young / (1 - s.poisson * s.poisson) * z; };
  const double half = s.thickness / 2;
  const double integral = s.thickness / 6 * (moment(-half) + 4 * moment(0) + moment(half));
  CHECK(s.bending_stiffness() == Approx(integral).epsilon(1e-14));            // measured: 4e-16
  CHECK(s.bending_stiffness() == Approx(18315018.315018315).epsilon(1e-14));  // measured: 4e-16
}

TEST_CASE("shear stiffness: k G h") {
  const Section steel{200e9, 0.3, 0.1, 5.0 / 6, 7850};
  CHECK(steel.shear_stiffness() == Approx(6410256410.256411).epsilon(1e-14));  // measured: 1e-16
  // S / D = 6 k (1 - nu) / h^2
  const Section other{70, 0.21, 3, 0.8, 0};
  CHECK(other.shear_stiffness() / other.bending_stiffness() == Approx(6 * 0.8 * 0.79 / 9).epsilon(1e-14));  // 0
  CHECK(Section{}.shear_correction == Approx(5.0 / 6));
}
