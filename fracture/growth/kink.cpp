#include "fracture/growth/kink.hpp"

#include <cmath>
#include <functional>
#include <numbers>

namespace fracture {
namespace {

/// The place of the largest value in [-pi/2, pi/2]: of half-degree steps, then by golden section.
double largest(const std::function<double(double)>& value) {
  constexpr int steps = 180;
  constexpr double width = std::numbers::pi / steps, ratio = 0.6180339887498949;  // (sqrt(5) - 1) / 2
  double best = 0;
  for (int i = -steps / 2; i <= steps / 2; ++i)
    if (value(i * width) > value(best)) best = i * width;
  double low = best - width, high = best + width;
  while (high - low > 1e-10) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    (value(a) > value(b) ? high : low) = value(a) > value(b) ? b : a;
  }
  return (low + high) / 2;
}

}  // namespace

Factors kinked(const Factors& f, double angle) {
  const double c = std::cos(angle / 2), s = std::sin(angle / 2);
  return {c * c * c * f.K1 - 3 * c * c * s * f.K2, c * c * s * f.K1 + c * (1 - 3 * s * s) * f.K2, c * f.K3};
}

double kink_angle(const Factors& f, Growth::Direction direction, const plate::Section& section) {
  // a tip that closes on one face opens on the other: the sign of the moments does not matter
  const Factors opening = f.K1 < 0 ? Factors{-f.K1, -f.K2, -f.K3} : f;
  switch (direction) {
    case Growth::Direction::straight:
      return 0;
    case Growth::Direction::tangential_moment:
      return opening.K2 == 0 ? 0 : largest([&](double angle) { return kinked(opening, angle).K1; });
    case Growth::Direction::energy_release: {
      const double bending = 12 / (section.young * std::pow(section.thickness, 3));
      const double shear = (1 + section.poisson) / (section.young * section.thickness) / section.shear_correction;
      return opening.K2 == 0 ? 0 : largest([&](double angle) {
        const Factors k = kinked(opening, angle);
        return bending * (k.K1 * k.K1 + k.K2 * k.K2) + shear * k.K3 * k.K3;
      });
    }
  }
  return 0;
}

}  // namespace fracture
