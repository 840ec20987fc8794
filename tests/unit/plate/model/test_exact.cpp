#include "tests/verification/exact.hpp"

#include <Eigen/Dense>
#include <numbers>
#include "tests/catch.hpp"
#include "tests/dense.hpp"

using plate::Section;
using namespace plate::exact;

namespace {

constexpr double pi = std::numbers::pi;
const Section thin{200e9, 0.3, 1e-4, 5.0 / 6, 7850}, thick{200e9, 0.3, 0.2, 5.0 / 6, 7850};

double D(const Section& s) {
  return s.young * s.thickness * s.thickness * s.thickness / 12 / (1 - s.poisson * s.poisson);
}

}  // namespace

TEST_CASE("deflection of a thin square plate: 0.00406235 p a^4 / D") {
  // Timoshenko & Woinowsky-Krieger, table 8: 0.00406 (square), 0.01013 (2 : 1)
  const double square = navier_deflection(thin, 2, 2, 5, 1, 1) * D(thin) / (5 * 16);
  CHECK(square == Approx(0.00406235).epsilon(2e-6));  // measured: 7e-7
  const double oblong = navier_deflection(thin, 2, 1, 5, 1, 0.5) * D(thin) / 5;
  CHECK(oblong == Approx(0.01013).epsilon(5e-4));  // measured: 1e-4, the digits printed
}

TEST_CASE("shear adds the membrane's deflection: 0.0736713533 p a^2 / (k G h)") {
  // a simply supported (hard) Mindlin plate: w = w_thin + M / (k G h) with the membrane M under p
  const double S = 5.0 / 6 * thick.young / 2.6 * thick.thickness;
  const double bending = 0.004062353 * 3 * 16 / D(thick);
  const double shear = navier_deflection(thick, 2, 2, 3, 1, 1) - bending;
  CHECK(shear > 0);
  CHECK(shear == Approx(0.0736713533 * 3 * 4 / S).epsilon(2e-4));  // measured: 2e-6, the series' tail
}

TEST_CASE("deflection is zero on the edges and symmetric") {
  const auto w = [](double x, double y) { return navier_deflection(thick, 3, 2, 1e6, x, y, 60); };
  const double centre = w(1.5, 1);
  CHECK(std::abs(w(0, 1)) < 1e-12 * centre);
  CHECK(std::abs(w(1.1, 2)) < 1e-12 * centre);
  CHECK(w(0.4, 0.3) == Approx(w(2.6, 1.7)).epsilon(1e-10));
  CHECK(w(0.4, 0.3) < centre);
}

TEST_CASE("frequency of a thin plate: (m^2/a^2 + n^2/b^2) pi/2 sqrt(D / (rho h))") {
  const double unit = pi / 2 * std::sqrt(D(thin) / (thin.density * thin.thickness));
  CHECK(natural_frequency(thin, 2, 3, 1, 1) == Approx((1.0 / 4 + 1.0 / 9) * unit).epsilon(1e-7));  // measured: 7e-9
  CHECK(natural_frequency(thin, 2, 3, 2, 1) == Approx((1 + 1.0 / 9) * unit).epsilon(1e-7));        // measured: 2e-8
}

TEST_CASE("frequency of a thick plate: the lowest eigenvalue of the amplitudes' matrices") {
  // w = W s s, psi_x = X c s, psi_y = Y s c in the strain and kinetic energy
  const double a = 2, b = 1.5, h = thick.thickness, nu = thick.poisson, S = 5.0 / 6 * thick.young / 2.6 * h;
  for (const auto& [m, n] : {std::pair{1, 1}, {2, 1}, {3, 4}}) {
    const double p = m * pi / a, q = n * pi / b, d = D(thick), g = d * (1 - nu) / 2;
    Eigen::Matrix3d K, M = Eigen::Vector3d(1, h * h / 12, h * h / 12).asDiagonal();
    K << S * (p * p + q * q), -S * p, -S * q,                     //
        -S * p, d * p * p + g * q * q + S, (d * nu + g) * p * q,  //
        -S * q, (d * nu + g) * p * q, d * q * q + g * p * p + S;
    M *= thick.density * h;
    const double expected = std::sqrt(dense::eigenvalues(K, M)[0]) / (2 * pi);
    CHECK(natural_frequency(thick, a, b, m, n) == Approx(expected).epsilon(1e-12));  // measured: 2e-15
  }
  CHECK(natural_frequency(thick, 2, 2, 1, 2) == natural_frequency(thick, 2, 2, 2, 1));
}

TEST_CASE("moments about a hole lie between those of thin plates and of plane stress") {
  const auto concentration = [](double thickness) {
    return plate::exact::hole_moment_concentration({1000, 0.3, thickness, 5.0 / 6, 1}, 1);
  };
  CHECK(concentration(1e-4) == Approx((5 + 3 * 0.3) / (3 + 0.3)).epsilon(1e-3));
  CHECK(concentration(1e3) == Approx(3).epsilon(1e-3));
  double before = 0;
  for (const double thickness : {0.01, 0.1, 0.5, 1.0, 2.0, 10.0}) {
    CHECK(concentration(thickness) > before);
    before = concentration(thickness);
  }
}
