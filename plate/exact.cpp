#include "plate/exact.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace plate::exact
