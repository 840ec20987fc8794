#include "plate/bonds/parameters/influence.hpp"

#include <algorithm>
#include <cmath>

namespace plate {
namespace {

double linear_share(double length, double horizon, double spacing) {
  return std::clamp((horizon + spacing / 2 - length) / spacing, 0.0, 1.0);
}

bool on_outermost_axis_shell(const Discretization& d, const Eigen::Vector2d& vector) {
  const double shell = std::floor(d.horizon_ratio * (1 + 1e-9)) * d.spacing;
  const double along = vector.cwiseAbs().maxCoeff(), across = vector.cwiseAbs().minCoeff();
  return std::abs(along - shell) < 1e-6 * d.spacing && across < 1e-6 * d.spacing;
}

/// f = 1 - (I4 - 3 I22) / I4 of the outermost axis shell: with it sum w xi^2 c^4 beta = 3 sum w xi^2 c^2 s^2 beta.
double fitted_factor(const Discretization& d) {
  double excess = 0, shell = 0;
  for (const auto& xi : full_family(d)) {
    const double length = xi.norm(), weight = influence(d.influence, length, d.horizon()) / (length * length) *
                                              linear_share(length, d.horizon(), d.spacing);
    const double fourth = weight * std::pow(xi.x(), 4);
    excess += fourth - 3 * weight * std::pow(xi.x() * xi.y(), 2);
    if (on_outermost_axis_shell(d, xi)) shell += fourth;
  }
  return 1 - excess / shell;
}

}  // namespace

double influence(Influence kind, double length, double horizon) {
  return kind == Influence::inverse ? horizon / length : 1;
}

double volume_share(const Discretization& d, const Eigen::Vector2d& vector) {
  if (vector.norm() > d.horizon() * (1 + 1e-9)) return 0;
  if (d.volume_correction == VolumeCorrection::none) return 1;
  const double share = linear_share(vector.norm(), d.horizon(), d.spacing);
  const bool fitted = d.volume_correction == VolumeCorrection::lattice_fitted && on_outermost_axis_shell(d, vector);
  return fitted ? share * fitted_factor(d) : share;
}

std::vector<Eigen::Vector2d> full_family(const Discretization& d) {
  const int reach = static_cast<int>(std::floor(d.horizon_ratio * (1 + 1e-9)));
  std::vector<Eigen::Vector2d> vectors;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if ((x != 0 || y != 0) && std::hypot(x, y) <= d.horizon_ratio * (1 + 1e-9))
        vectors.emplace_back(x * d.spacing, y * d.spacing);
  return vectors;
}

}  // namespace plate
