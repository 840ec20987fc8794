#include "plate/formulation/resultants.hpp"

#include <cmath>

namespace plate {

/// Squares of shares: those of the stresses themselves may be beyond double precision.
double von_mises(const Eigen::Vector3d& moments, const Section& section) {
  const Eigen::Vector3d stress = moments * (6 / (section.thickness * section.thickness));
  const double size = stress.lpNorm<Eigen::Infinity>();
  if (size == 0) return 0;
  const Eigen::Vector3d s = stress / size;
  return size * std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]);
}

Resultants resultants_of(Eigen::Index points) {
  return {Eigen::Matrix3Xd(3, points), Eigen::Matrix2Xd(2, points), Eigen::VectorXd(points)};
}

void set(Resultants& result, Eigen::Index k, const Section& section, const Eigen::Matrix2d& theta,
         const Eigen::Vector2d& shear) {
  const double D = section.bending_stiffness(), nu = section.poisson;
  // strains at z: z * (theta_y,x , -theta_x,y , theta_y,y - theta_x,x)
  const double xx = theta(1, 0), yy = -theta(0, 1), twice_xy = theta(1, 1) - theta(0, 0);
  result.moments.col(k) << D * (xx + nu * yy), D * (yy + nu * xx), D * (1 - nu) / 2 * twice_xy;
  result.shear.col(k) = shear;
  result.von_mises[k] = von_mises(result.moments.col(k), section);
}

}  // namespace plate
