#pragma once
#include "geometry/shape/crack_path.hpp"

namespace plate {

/// Axes at a crack tip: x' straight ahead, y' 90 degrees to its left.
struct TipFrame {
  geometry::Point origin, ahead;

  explicit TipFrame(const geometry::Tip& tip) : origin(tip.position), ahead(tip.direction) {}
  geometry::Point left() const { return {-ahead.y(), ahead.x()}; }
  geometry::Point local(const geometry::Point& x) const { return {ahead.dot(x - origin), left().dot(x - origin)}; }
};

/// Side of the crack on which geometry::severs puts a point: +1 for y' > 0, -1 for y' < 0. A point on the line itself
/// lies where moving it by (e, e^2) would put it. `y`: its y' [length], zero below 1e-7 spacings.
int face_of(double y, const geometry::Point& left, double spacing);

/// Polar coordinates in the tip's axes; angle in [-pi, pi], +-pi on the faces.
struct Polar {
  double r, angle;
};
Polar polar(const TipFrame& frame, const geometry::Point& x, double spacing);

}  // namespace plate
