#include "plate/formulation/tip_view.hpp"

#include <cmath>
#include <numbers>

#include "geometry/shape/smooth_curve.hpp"

namespace plate {
namespace {

/// Spacings; points of a face are seen 2e-6 of the distance to their neighbours beside it, some half a spacing.
constexpr double on_line = 1e-7;

}  // namespace

int face_of(double y, const geometry::Point& left, double spacing) {
  if (std::abs(y) > on_line * spacing) return y > 0 ? 1 : -1;
  const double towards = std::abs(left.x()) > 1e-12 ? left.x() : left.y();
  return towards > 0 ? 1 : -1;
}

geometry::Point TipFrame::by_circle(const geometry::Point& x) const {
  const auto at = local(x);
  if (curvature == 0) return at;
  const double along = curvature * at.x(), aside = 1 - curvature * at.y();
  return {std::atan2(along, aside) / curvature, (1 - std::hypot(along, aside)) / curvature};
}

geometry::Point TipFrame::beside(const geometry::Point& x) const {
  const auto at = by_circle(x);
  if (curve.empty() || at.x() >= 0) return at;
  return {at.x(), geometry::signed_distance(curve, x)};
}

Polar polar(const TipFrame& frame, const geometry::Point& x, double spacing) {
  const auto at = frame.local(x);
  if (!frame.curve.empty()) {  // the angle goes on beyond pi as far as the face does
    const double angle = std::atan2(at.y(), at.x());
    if (std::abs(angle) < std::numbers::pi / 2) return {at.norm(), angle};
    const bool left = geometry::signed_distance(frame.curve, x) > 0;
    const double turn = left == (angle > 0) ? 0 : left ? 2 * std::numbers::pi : -2 * std::numbers::pi;
    return {at.norm(), angle + turn};
  }
  if (at.x() < 0 && std::abs(at.y()) <= on_line * spacing)
    return {-at.x(), face_of(0, frame.left(), spacing) * std::numbers::pi};
  return {at.norm(), std::atan2(at.y(), at.x())};
}

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
