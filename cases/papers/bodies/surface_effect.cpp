#include "cases/papers/bodies/surface_effect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace boundary_bodies {
namespace {

/// Gauss, four points on each of `parts` parts.
double gauss_integral(const std::function<double(double)>& f, double from, double to, int parts = 40) {
  constexpr std::array<double, 2> at{0.339981043584856, 0.861136311594053},
      weight{0.652145154862546, 0.347854845137454};
  const double half = (to - from) / (2 * parts);
  double sum = 0;
  for (int i = 0; i < parts; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      for (const double side : {-1.0, 1.0}) sum += weight[k] * half * f(from + half * (2 * i + 1 + side * at[k]));
  return sum;
}

/// Force between the points a and b over E strain.
double pull_between(double a, double b) {
  return 1 / weighted_volume_near_end(a) + 1 / weighted_volume_near_end(b);
}

}  // namespace

double weighted_volume_near_end(double x) {
  return x < 1 ? (x * x + 1) / 2 : 1;
}

double flux_near_end(double x) {
  if (x < 1) return 2 * (1 - 2 * x) * std::atan(x) + std::log(x * x + 1) + x * x / 2 + std::numbers::pi * x / 2;
  const double y = x - 1;
  return x > 2 ? 1
               : 2 * y * std::atan(y) - std::log((y * y + 1) / 2) - y * y / 2 + (1 - std::numbers::pi / 2) * y + 0.5;
}

double load_near_end(double x) {
  const double y = x - 1, quarter = std::numbers::pi / 2;
  if (x < 1) return 4 * std::atan(x) + 2 * y / (x * x + 1) - x - quarter;
  return x > 2 ? 0 : -2 * std::atan(y) + x - 2 + quarter;
}

double integral_in_parts(const std::function<double(double)>& f, double from, double to) {
  return from < 1 && to > 1 ? gauss_integral(f, from, 1) + gauss_integral(f, 1, to) : gauss_integral(f, from, to);
}

double integrated_weighted_volume(double x) {
  const auto length = [x](double y) { return std::abs(y - x); };
  return integral_in_parts(length, std::max(0.0, x - 1), x) + integral_in_parts(length, x, x + 1);
}

double integrated_flux(double x) {
  const auto from = [x](double a) { return integral_in_parts([a](double b) { return pull_between(a, b); }, x, a + 1); };
  return integral_in_parts(from, std::max(0.0, x - 1), x);
}

double integrated_load(double x) {
  const auto pull = [x](double y) { return pull_between(x, y); };
  return integral_in_parts(pull, std::max(0.0, x - 1), x) - integral_in_parts(pull, x, x + 1);
}

double place_of(const std::function<double(double)>& f, double level, double low, double high) {
  while (high - low > 1e-12) (f((low + high) / 2) < level ? low : high) = (low + high) / 2;
  return low;
}

}  // namespace boundary_bodies
