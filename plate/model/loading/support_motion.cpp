#include "plate/model/loading/support_motion.hpp"

#include "plate/model/problem.hpp"

namespace plate {

using geometry::Point;

/// theta_x = psi_y, theta_y = -psi_x
Eigen::Vector3d SupportMotion::at(const Point& x) const {
  return {deflection + slope.dot(x - from), slope.y(), -slope.x()};
}

Eigen::Vector3d SupportMotion::at(const Point& x, const Point& outward, double beyond) const {
  return at(x) + rotation * Eigen::Vector3d(beyond, outward.y(), -outward.x());
}

std::vector<SupportMotion> support_motions(const Problem& problem) {
  std::vector<SupportMotion> result;
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (const auto& load = problem.loads[i]; load.kind == Load::Kind::settlement)
      result.push_back({i, load.support, load.value, load.slope, load.from, load.rotation});
  return result;
}

}  // namespace plate
