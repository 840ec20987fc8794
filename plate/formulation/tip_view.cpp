#include "plate/formulation/tip_view.hpp"

#include <cmath>
#include <numbers>

namespace plate {

using geometry::Point;

double Ring::extension(double r) const {
  if (r <= inner) return 1;
  if (r >= outer) return 0;
  return (1 + std::cos(std::numbers::pi * (r - inner) / (outer - inner))) / 2;
}

double Ring::slope(double r) const {
  if (r <= inner || r >= outer) return 0;
  const double width = outer - inner;
  return -std::numbers::pi / (2 * width) * std::sin(std::numbers::pi * (r - inner) / width);
}

NearField::NearField(const State& state, const std::vector<Point>& positions, const std::vector<std::uint32_t>& centre)
    : state_(state), positions_(positions) {
  for (const auto k : centre) {
    mean_ += state.col(k) / double(centre.size());
    place_ += positions[k] / double(centre.size());
  }
}

Kinematics<> NearField::operator()(std::uint32_t k) const {
  const Point x = positions_[k] - place_;
  const auto u = state_.col(k);
  return {u[0] - mean_[0] + mean_[2] * x.x() - mean_[1] * x.y(), u[1] - mean_[1], u[2] - mean_[2]};
}

}  // namespace plate
