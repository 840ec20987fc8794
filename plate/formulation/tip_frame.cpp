#include "plate/formulation/tip_frame.hpp"

#include <cmath>
#include <numbers>

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

Polar polar(const TipFrame& frame, const geometry::Point& x, double spacing) {
  const auto at = frame.local(x);
  if (at.x() < 0 && std::abs(at.y()) <= on_line * spacing)
    return {-at.x(), face_of(0, frame.left(), spacing) * std::numbers::pi};
  return {at.norm(), std::atan2(at.y(), at.x())};
}

}  // namespace plate
