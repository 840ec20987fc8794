#include "cases/papers/bodies/fractions.hpp"

#include <set>

namespace boundary_bodies {

namespace {

/// Area of the disc inside [0, x] x [0, y], x and y positive.
double quadrant(double r, double x, double y) {
  if (x * x + y * y <= r * r) return x * y;
  x = std::min(x, r), y = std::min(y, r);
  const auto below = [r](double t) {
    return (t * std::sqrt(std::max(0.0, r * r - t * t)) + r * r * std::asin(t / r)) / 2;
  };
  const double straight = std::sqrt(std::max(0.0, r * r - y * y));  // -0 and less where y is r, of a fused product
  return straight * y + (x > straight ? below(x) - below(straight) : 0);
}

double odd_quadrant(double r, double x, double y) {
  return (x < 0 ? -1 : 1) * (y < 0 ? -1 : 1) * quadrant(r, std::abs(x), std::abs(y));
}

/// Integral of what has roots at the ends (tanh-sinh rule).
double integral(const std::function<double(double)>& f, double from, double to) {
  double sum = 0;
  for (double t = -4; t < 4.001; t += 0.0625) {
    const double s = std::numbers::pi / 2 * std::sinh(t), c = std::cosh(s);
    const double weight = std::numbers::pi / 2 * std::cosh(t) / (c * c);
    sum += weight * f(from + (to - from) / (1 + std::exp(-2 * s)));
  }
  return sum * 0.0625 * (to - from) / 2;
}

}  // namespace

double area_in_disc(double radius, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return odd_quadrant(radius, high[0], high[1]) - odd_quadrant(radius, low[0], high[1]) -
         odd_quadrant(radius, high[0], low[1]) + odd_quadrant(radius, low[0], low[1]);
}

double volume_in_ball(double radius, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  std::set<double> breaks{std::max(low[2], -radius), std::min(high[2], radius)};
  const auto add = [&](double squared) {
    const double rest = radius * radius - squared;
    if (rest < 0) return;
    for (const double z : {-std::sqrt(rest), std::sqrt(rest)})
      if (z > low[2] && z < high[2]) breaks.insert(z);
  };
  for (const double x : {low[0], high[0], 0.0})
    for (const double y : {low[1], high[1], 0.0}) add(x * x + y * y);
  double sum = 0;
  for (auto from = breaks.begin(), to = std::next(from); to != breaks.end(); from = to++)
    sum += integral(
        [&](double z) {
          return area_in_disc(std::sqrt(std::max(0.0, radius * radius - z * z)), low.head<2>(), high.head<2>());
        },
        *from, *to);
  return low[2] >= radius || high[2] <= -radius ? 0 : sum;
}

Family family_of(int dimension, double horizon_ratio) {
  const int reach = int(std::floor(horizon_ratio + 0.5));
  const auto fraction = [&](const Eigen::Vector3d& x) -> double {
    const Eigen::Vector3d low = x.array() - 0.5, high = x.array() + 0.5;
    if (dimension == 1) return std::clamp(horizon_ratio - (x.cwiseAbs()[0] - 0.5), 0.0, 1.0);
    if (low.cwiseAbs().cwiseMax(high.cwiseAbs()).head(dimension).norm() <= horizon_ratio) return 1;
    if ((x.cwiseAbs().array() - 0.5).max(0).matrix().head(dimension).norm() >= horizon_ratio) return 0;
    return dimension == 2 ? area_in_disc(horizon_ratio, low.head<2>(), high.head<2>())
                          : volume_in_ball(horizon_ratio, low, high);
  };
  Family family;
  const int y_reach = dimension > 1 ? reach : 0, z_reach = dimension > 2 ? reach : 0;
  std::map<std::array<int, 3>, double> known;  // of places that differ by a reflection
  for (int z = -z_reach; z <= z_reach; ++z)
    for (int y = -y_reach; y <= y_reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        std::array<int, 3> key{std::abs(x), std::abs(y), std::abs(z)};
        std::sort(key.begin(), key.begin() + dimension);
        auto found = known.find(key);
        if (found == known.end()) found = known.emplace(key, fraction(Eigen::Vector3d(key[0], key[1], key[2]))).first;
        if ((x != 0 || y != 0 || z != 0) && found->second > 0) family.push_back({{x, y, z}, found->second});
      }
  return family;
}

double mean_of_directions(const Family& family, double horizon, const Influence& influence, int p, int q) {
  double sum = 0, all = 0;
  for (const auto& [away, fraction] : family) {
    const Eigen::Vector3d x = away.matrix().cast<double>();
    const double weight = influence(x.norm() / horizon) * x.squaredNorm() * fraction;
    sum += weight * std::pow(x[0] / x.norm(), p) * std::pow(x[1] / x.norm(), q);
    all += weight;
  }
  return sum / all;
}

Family fitted(Family plane, double horizon, const Influence& influence) {
  double apart = 0, shell = 0;
  for (const auto& [away, fraction] : plane) {
    const Eigen::Vector3d x = away.matrix().cast<double>();
    const double weight = influence(x.norm() / horizon) * fraction * x.squaredNorm() / std::pow(x.norm(), 4);
    const double excess = weight * (std::pow(x[0], 4) - 3 * x[0] * x[0] * x[1] * x[1]);
    apart += excess;
    if (away.abs().maxCoeff() == 3 && away.abs().sum() == 3) shell += excess;
  }
  for (auto& [away, fraction] : plane)
    if (away.abs().maxCoeff() == 3 && away.abs().sum() == 3) fraction *= 1 - apart / shell;
  return plane;
}

}  // namespace boundary_bodies
