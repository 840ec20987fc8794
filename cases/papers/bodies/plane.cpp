#include "cases/papers/bodies/plane.hpp"

#include "cases/papers/bodies/equilibrium.hpp"

namespace boundary_bodies {

namespace {

constexpr double young = 1, c_u = 0.05, c_v = -0.06;

/// Sca23 43 with the moduli given: C11 strain_x + C12 strain_y = 0, C12 strain_x + C11 strain_y = 1.
Field pulled_field(double C11, double C12) {
  const double det = C11 * C11 - C12 * C12;
  return [=](const Eigen::Vector3d& x) { return Eigen::Vector3d(-C12 / det * x[0], C11 / det * x[1], 0); };
}

}  // namespace

Solid plane_square(double poisson, int count) {
  return {
      box_body({count, count}, 3), plane_strain_material(young, poisson), family_of(2, 3), 1.0 / count, 3, 1, gauss};
}

Field pulled_square(double poisson) {
  const double factor = young / ((1 + poisson) * (1 - 2 * poisson));
  return pulled_field(factor * (1 - poisson), factor * poisson);
}

Field pulled_square_of_lattice(const Solid& s) {
  const double fourth = mean_of_directions(s.family, s.horizon, s.influence, 4, 0),
               mixed = mean_of_directions(s.family, s.horizon, s.influence, 2, 2);
  const double k_theta = s.material.k_theta, k_e = s.material.k_e;
  return pulled_field(k_theta / 2 + k_e * fourth, k_theta / 2 + k_e * mixed);
}

Eigen::Vector3d made_field(const Eigen::Vector3d& x) {
  return {c_u * x[0] * x[1], c_v * x[0] * x[0] * x[0], 0};
}

Conditions made(const Solid& s, double poisson, bool nonlocal) {
  const double mu = young / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson);
  // 1/16: mean of m_1^4 m_2^2 over a circle; integrals of exp(-t^2) t^3 and, halved, of exp(-t^2) t^5 to t = 1, times
  // horizon^2: the plane's Delta_1 and Delta_2 of Sca23 53, 55
  const double e = std::exp(-1.0), delta = s.horizon * s.spacing, D1 = (1 - 2 * e) / 2, D2 = (2 - 5 * e) / 4;
  const double beyond = nonlocal ? c_v * s.material.k_e / 16 * delta * delta * D2 / D1 : 0;
  return {[](const plate::SurfaceNode& n, int) { return n.side < 0 && n.axis == 0; }, made_field,
          [=](const Eigen::Vector3d& x, const Eigen::Vector3d& n) {
            const double shear = mu * (c_u * x[0] + 3 * c_v * x[0] * x[0]) + beyond;
            return Eigen::Vector3d((lambda + 2 * mu) * c_u * x[1] * n[0] + shear * n[1],
                                   shear * n[0] + lambda * c_u * x[1] * n[1], 0);
          },
          [=](const Eigen::Vector3d& x) { return Eigen::Vector3d(0, -(lambda + mu) * c_u - 6 * mu * c_v * x[0], 0); }};
}

}  // namespace boundary_bodies
