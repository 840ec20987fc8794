#include "tests/verification/exact.hpp"

#include <cmath>
#include <numbers>

#include "plate/model/dense_algebra.hpp"

namespace plate::exact {

using std::numbers::pi;

double navier_deflection(const Section& section, double a, double b, double pressure, double x, double y, int terms) {
  const double D = section.bending_stiffness(), S = section.shear_stiffness();
  double w = 0;
  for (int i = terms - 1; i >= 0; --i)
    for (int j = terms - 1; j >= 0; --j) {
      const int m = 2 * i + 1, n = 2 * j + 1;
      const double p = 16 * pressure / (pi * pi * m * n);
      const double k2 = std::pow(m * pi / a, 2) + std::pow(n * pi / b, 2);
      w += p / (D * k2 * k2) * (1 + D * k2 / S) * std::sin(m * pi * x / a) * std::sin(n * pi * y / b);
    }
  return w;
}

double natural_frequency(const Section& section, double a, double b, int m, int n) {
  // with W, psi = Psi grad: (S k2 - mu w2) W - S k2 Psi = 0, -S W + (D k2 + S - J w2) Psi = 0
  const double D = section.bending_stiffness(), S = section.shear_stiffness();
  const double mu = section.density * section.thickness, J = mu * section.thickness * section.thickness / 12;
  const double k2 = std::pow(m * pi / a, 2) + std::pow(n * pi / b, 2);
  const double second = mu * J, first = mu * (D * k2 + S) + J * S * k2, zeroth = S * k2 * D * k2;
  const double square = 2 * zeroth / (first + std::sqrt(first * first - 4 * second * zeroth));
  return std::sqrt(square) / (2 * pi);
}

// Of the part with cos 2 phi: w = (B r^-2 + C) cos, psi = grad(w + D/S lap w) + rot(E K_2(lambda r) sin), b = B - 4 C
// D/S, with M_r = M_rs = Q_r = 0 on the hole. Lengths in radii, D = 1.
double hole_moment_concentration(const Section& section, double radius) {
  const double nu = section.poisson, S = section.shear_stiffness() / section.bending_stiffness() * radius * radius;
  const double lambda = std::sqrt(2 * S / (1 - nu));
  // K_1 / K_2; for large arguments both are too small for numbers
  const double ratio =
      lambda < 300 ? std::cyl_bessel_k(1.0, lambda) / std::cyl_bessel_k(2.0, lambda) : 1 - 1.5 / lambda;
  // derivatives of K_2(lambda r) at r = 1, over K_2: from K_2' = -K_1 - 2 K_2 / x and Bessel's equation
  const double slope = -lambda * ratio - 2, bend = lambda * lambda + 4 - slope;
  // columns b, C, E K_2: psi_r, its derivative, psi_s, its derivative, at r = 1
  const Eigen::Matrix<double, 4, 3> psi{{-2, 0, 2}, {6, 0, 2 * slope - 2}, {-2, -2, -slope}, {6, 2, -bend}};
  const Eigen::RowVector3d hoop = psi.row(0) + 2 * psi.row(2);  // psi_r / r + psi_s,phi / r
  Eigen::Matrix3d free;
  free << psi.row(1) + nu * hoop,                                  // M_r
      (1 - nu) / 2 * (-2 * psi.row(0) + psi.row(3) - psi.row(2)),  // M_rs
      0, -8, -2 * S;                                               // Q_r
  const Eigen::Vector3d factors = least_norm(free, Eigen::Vector3d(-0.5, 0.5, 0)).x;
  return 1.5 - (hoop + nu * psi.row(1)).dot(factors);
}

}  // namespace plate::exact
