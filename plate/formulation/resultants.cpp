#include "plate/formulation/resultants.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace plate {

namespace {

/// Squares of shares: those of the stresses themselves may be beyond double precision.
double von_mises(const Eigen::Vector3d& stress) {
  const double size = stress.lpNorm<Eigen::Infinity>();
  if (size == 0) return 0;
  const Eigen::Vector3d s = stress / size;
  return size * std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]);
}

}  // namespace

double von_mises(const Eigen::Vector3d& moments, const Section& section) {
  if (section.isotropic()) return von_mises(Eigen::Vector3d(moments * (6 / (section.thickness * section.thickness))));
  const LocalSection l(section);
  return von_mises(Eigen::Vector3d(l.top * l.bending.ldlt().solve(moments)));
}

Resultants resultants_of(Eigen::Index points) {
  return {Eigen::Matrix3Xd(3, points), Eigen::Matrix2Xd(2, points), Eigen::VectorXd(points)};
}

void set(Resultants& result, Eigen::Index k, const LocalSection& section, const Eigen::Matrix2d& theta,
         const Eigen::Vector2d& shear) {
  // strains at z: z * (theta_y,x , -theta_x,y , theta_y,y - theta_x,x)
  const Eigen::Vector3d strains(theta(1, 0), -theta(0, 1), theta(1, 1) - theta(0, 0));
  result.moments.col(k) = section.bending * strains;
  result.shear.col(k) = shear;
  result.von_mises[k] = von_mises(section.top * strains);
}

}  // namespace plate
