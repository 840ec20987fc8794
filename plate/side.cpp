#include "plate/boundary.hpp"

#include <cmath>

namespace plate {

using geometry::Point;

double Side::inside(const Point& u) const {
  if (circle) return (u - centre).norm() - radius;
  return -outward(u).dot(u - edge.from);
}

Point Side::outward(const Point& u) const {
  if (circle) return (centre - u).normalized();
  const Point along = (edge.to - edge.from).normalized();
  return {along.y(), -along.x()};
}

int Side::normal_axis() const {
  if (circle) return -1;
  if (edge.from.x() == edge.to.x()) return 0;
  return edge.from.y() == edge.to.y() ? 1 : -1;
}

bool Side::along_lattice() const {
  const int axis = normal_axis();
  return axis >= 0 && edge.from[axis] == std::round(edge.from[axis]);
}

Point Side::mirrored(const Point& u) const {
  Point image = u;
  image[normal_axis()] = 2 * edge.from[normal_axis()] - u[normal_axis()];
  return image;
}

}  // namespace plate
