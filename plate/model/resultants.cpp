#include "plate/model/resultants.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace plate {
namespace {

double von_mises(const Eigen::Vector3d& stress) {
  return std::sqrt(stress[0] * stress[0] - stress[0] * stress[1] + stress[1] * stress[1] +
                   3 * stress[2] * stress[2]);
}

Resultants zero_resultants(Eigen::Index points) {
  return {Eigen::Matrix3Xd(3, points), Eigen::Matrix2Xd(2, points), Eigen::VectorXd(points)};
}

/// `theta`: as in Gradients. `shear`: shear force.
void set(Resultants& result, Eigen::Index k, const Section& section, const Eigen::Matrix2d& theta,
         const Eigen::Vector2d& shear) {
  const double D = section.bending_stiffness(), nu = section.poisson, h = section.thickness;
  // strains at z: z * (theta_y,x , -theta_x,y , theta_y,y - theta_x,x)
  const double xx = theta(1, 0), yy = -theta(0, 1), twice_xy = theta(1, 1) - theta(0, 0);
  result.moments.col(k) << D * (xx + nu * yy), D * (yy + nu * xx), D * (1 - nu) / 2 * twice_xy;
  result.shear.col(k) = shear;
  result.von_mises[k] = von_mises(result.moments.col(k) * (6 / (h * h)));
}

}  // namespace

Gradients gradients(std::size_t k, const State& state, const geometry::Families& families,
                    const std::vector<BondShape>& shapes, const std::vector<double>& areas) {
  const auto kinematics = [&](std::size_t i) {
    const auto u = state.col(static_cast<Eigen::Index>(i));
    return Kinematics<>{u[0], u[1], u[2]};
  };
  const Kinematics<> own = kinematics(k);
  Gradients sum;
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
  for (const auto [j, id] : families[k]) {
    const BondShape& bond = shapes[id];
    const Kinematics<> other = kinematics(j);
    const Eigen::Vector2d xi = families.vectors()[id] * (bond.weight * areas[j]);
    shape += xi * families.vectors()[id].transpose();
    sum.theta += Eigen::Vector2d(other.theta_x - own.theta_x, other.theta_y - own.theta_y) * xi.transpose();
    sum.shear += xi * shear_difference(bond, own, other);
  }
  // a family on one line has no gradient across it: the least-norm inverse leaves it zero
  const double trace = shape.trace();
  const bool regular = shape.determinant() > 1e-8 * trace * trace;
  const Eigen::Matrix2d inverse = regular ? Eigen::Matrix2d(shape.inverse()) : shape.completeOrthogonalDecomposition().pseudoInverse();
  return {sum.theta * inverse, inverse * sum.shear};
}

Resultants resultants(const State& state, const geometry::Families& families, const std::vector<BondShape>& shapes,
                      const std::vector<double>& areas, std::size_t plate_points, const Section& section) {
  const auto count = static_cast<Eigen::Index>(plate_points);
  Resultants result = zero_resultants(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const Gradients g = gradients(static_cast<std::size_t>(k), state, families, shapes, areas);
    set(result, k, section, g.theta, section.shear_stiffness() * g.shear);
  }
  return result;
}

Resultants resultants(const State& state, const GalerkinFamilies& families, const Section& section) {
  const auto count = static_cast<Eigen::Index>(families.areas.size());
  Resultants result = zero_resultants(count);
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto strains = family_strains(families, std::size_t(k), state);
    const GalerkinStiffness stiffness(section, families.square(std::size_t(k)));
    Eigen::Matrix2d theta;  // psi = (-theta_y, theta_x)
    theta << strains.psi.row(1), -strains.psi.row(0);
    set(result, k, section, theta, stiffness.shear * strains.gamma);
  }
  return result;
}

}  // namespace plate
