#include "plate/bonds/resultants.hpp"

#include <Eigen/LU>

#include "plate/model/algebra/dense.hpp"

namespace plate {

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
  const Eigen::Matrix2d inverse =
      regular ? Eigen::Matrix2d(shape.inverse()) : Eigen::Matrix2d(pseudo_inverse(shape).inverse);
  return {sum.theta * inverse, inverse * sum.shear};
}

Resultants resultants(const State& state, const geometry::Families& families, const std::vector<BondShape>& shapes,
                      const std::vector<double>& areas, std::size_t plate_points, const Section& section) {
  const auto count = static_cast<Eigen::Index>(plate_points);
  Resultants result = resultants_of(count);
  const LocalSection local(section);
  const double S = section.shear_stiffness();
#pragma omp parallel for schedule(static)
  for (Eigen::Index k = 0; k < count; ++k) {
    const Gradients g = gradients(static_cast<std::size_t>(k), state, families, shapes, areas);
    set(result, k, local, g.theta, S * g.shear);
  }
  return result;
}

}  // namespace plate
