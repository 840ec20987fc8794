#include "plate/solve/motion/damping.hpp"

#include <cmath>
#include <numbers>

namespace plate {

Damping damping_of(const std::array<double, 2>& ratios, const std::array<double, 2>& frequencies) {
  const double a = 2 * std::numbers::pi * frequencies[0], b = 2 * std::numbers::pi * frequencies[1];
  const double squares = b * b - a * a;
  return {2 * a * b * (ratios[0] * b - ratios[1] * a) / squares, 2 * (ratios[1] * b - ratios[0] * a) / squares};
}

}  // namespace plate
