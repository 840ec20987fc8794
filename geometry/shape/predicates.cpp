#include "geometry/shape/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace geometry {

int side(const Point& a, const Point& b, const Point& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  return CGAL::orientation(Kernel::Point_2(a.x(), a.y()), Kernel::Point_2(b.x(), b.y()), Kernel::Point_2(c.x(), c.y()));
}

bool boxes_meet(const Point& p, const Point& q, const Point& a, const Point& b) {
  return std::max(a.x(), b.x()) >= std::min(p.x(), q.x()) && std::min(a.x(), b.x()) <= std::max(p.x(), q.x()) &&
         std::max(a.y(), b.y()) >= std::min(p.y(), q.y()) && std::min(a.y(), b.y()) <= std::max(p.y(), q.y());
}

int position(const Ring& ring, const Point& x) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = next(ring, i);
    if (std::max(a.y(), b.y()) < x.y() || std::min(a.y(), b.y()) > x.y() || std::max(a.x(), b.x()) < x.x()) continue;
    const int s = side(a, b, x);
    if (s == 0 && std::min(a.x(), b.x()) <= x.x()) return 0;
    if ((a.y() > x.y()) != (b.y() > x.y()) && (s > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside ? 1 : -1;
}

double signed_area(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) twice += cross(ring[i] - ring[0], next(ring, i) - ring[0]);
  return twice / 2;
}

Point nearest_on_segment(const Point& a, const Point& b, const Point& x) {
  const Point d = b - a;
  const double square = d.squaredNorm();
  return square > 0 ? Point(a + std::clamp(d.dot(x - a) / square, 0.0, 1.0) * d) : a;
}

double distance_to_segment(const Point& a, const Point& b, const Point& x) {
  const Point d = b - a;
  const double square = d.squaredNorm();
  const double t = square > 0 ? std::clamp((x - a).dot(d) / square, 0.0, 1.0) : 0.0;
  return (x - a - t * d).norm();
}

std::string at(const Point& x) {
  return text("(", x.x(), ", ", x.y(), ")");
}

}  // namespace geometry
