#include "plate/bonds/parameters/own_family.hpp"

namespace plate {
namespace {

Kinematics<> kinematics(const State& state, std::uint32_t k) {
  return {state(0, k), state(1, k), state(2, k)};
}

double dilatation(const OwnFamily& family, const State& state) {
  const auto own = kinematics(state, family.point);
  double sum = 0;
  for (const auto& bond : family.bonds)
    sum += bond.weights.D * curvature_difference(bond, own, kinematics(state, bond.neighbour));
  return sum;
}

}  // namespace

double energy(const OwnFamily& family, const State& a, const State& b) {
  const auto own_a = kinematics(a, family.point), own_b = kinematics(b, family.point);
  double sum = family.a * dilatation(family, a) * dilatation(family, b);
  for (const auto& bond : family.bonds) {
    const auto other_a = kinematics(a, bond.neighbour), other_b = kinematics(b, bond.neighbour);
    sum += bond.weights.B * curvature_difference(bond, own_a, other_a) * curvature_difference(bond, own_b, other_b) +
           bond.weights.S * shear_difference(bond, own_a, other_a) * shear_difference(bond, own_b, other_b);
  }
  return family.area * sum;
}

void add_force(const OwnFamily& family, const State& state, double share, Forces& forces) {
  const auto own = kinematics(state, family.point);
  const double twice = 2 * share * family.area, q = twice * family.a * dilatation(family, state);
  Eigen::Vector3d sum(0, 0, 0);
  for (const auto& bond : family.bonds) {
    const auto other = kinematics(state, bond.neighbour);
    const double bend = bond.weights.D * q + twice * bond.weights.B * curvature_difference(bond, own, other);
    const double shear = twice * bond.weights.S * shear_difference(bond, own, other);
    const double lever = shear * bond.length / 2, near = bend + lever, far = lever - bend;
    sum += Eigen::Vector3d(shear, bond.mx * near, bond.my * near);
    forces.col(bond.neighbour) += Eigen::Vector3d(-shear, bond.mx * far, bond.my * far);
  }
  forces.col(family.point) += sum;
}

}  // namespace plate
