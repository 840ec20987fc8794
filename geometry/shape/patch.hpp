#pragma once
#include "geometry/shape/outline.hpp"

namespace geometry {

/// Integrals over an area of 1, x and x x^T, x from a place.
struct AreaMoments {
  double area = 0;
  Point first{0, 0};
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
};

/// Area moments of the region that a ring encloses, about the place `about`; negative where the ring runs clockwise.
AreaMoments moments(const std::vector<Point>& ring, const Point& about);

/// A circle or polygon at another place.
Hole moved(Hole shape, const Point& by);

/// A part of the plane with a boundary: a polygon, or a circle as the regular polygon of the same area.
class Patch {
public:
  explicit Patch(const Hole& shape);

  /// Counter-clockwise.
  const std::vector<Point>& ring() const& { return ring_; }
  std::vector<Point> ring() && { return std::move(ring_); }

  /// Intersection with a convex cell, counter-clockwise: the ring of the cell, an empty ring, or the remaining part of
  /// the patch's ring (Sutherland, Hodgman 1974; parts that such clipping leaves connected are joined by lines without
  /// area).
  std::vector<Point> common(const std::vector<Point>& cell) const;

  /// True where the patch has an area in common with the plate. One that is thinner than a fortieth of what both span
  /// may be overlooked.
  bool meets(const Outline& outline) const;

private:
  std::vector<Point> ring_;
};

}  // namespace geometry
