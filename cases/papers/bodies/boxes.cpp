#include "cases/papers/bodies/boxes.hpp"

#include "cases/papers/bodies/equilibrium.hpp"
#include "cases/papers/bodies/fractions.hpp"

namespace boundary_bodies {
namespace {

constexpr double box_young = 1e9, box_poisson = 0.3;
constexpr double made_u = 0.05, made_v = -0.06, made_w = -0.02;  // c_u, c_v, c_w of Sca23 42

}  // namespace

Solid elastic_box(const std::vector<int>& counts, double spacing) {
  static const Family family = family_of(3, 3);
  return {.body = box_body(counts, 3),
          .material = space_material(box_young, box_poisson),
          .family = family,
          .spacing = spacing,
          .horizon = 3,
          .section = 1,
          .influence = gauss};
}

Eigen::Vector3d pulled_box(const Eigen::Vector3d& x) {
  return {x[0] / box_young, -box_poisson / box_young * x[1], -box_poisson / box_young * x[2]};
}

Field pulled_box_of_lattice(const Solid& s) {
  // C11 strain_x + 2 C12 strain_y = 1, C12 strain_x + (C11 + C12) strain_y = 0
  const double C11 = s.material.k_theta / 3 + s.material.k_e * mean_of_directions(s.family, 3, s.influence, 4, 0);
  const double C12 = s.material.k_theta / 3 + s.material.k_e * mean_of_directions(s.family, 3, s.influence, 2, 2);
  const double det = C11 * (C11 + C12) - 2 * C12 * C12, along = (C11 + C12) / det, across = -C12 / det;
  return [=](const Eigen::Vector3d& x) { return Eigen::Vector3d(along * x[0], across * x[1], across * x[2]); };
}

MadeBox::MadeBox(const std::vector<int>& counts, double length)
    : solid(elastic_box(counts, length / counts[0])),
      middle(Eigen::Vector3d(0, counts[1], counts[2]) / 2 * solid.spacing) {}

Field MadeBox::field() const {
  return [from = middle](const Eigen::Vector3d& at) {
    const Eigen::Vector3d x = at - from;
    return Eigen::Vector3d(made_u * x[0] * x[1], made_v * x[0] * x[0] * x[0], made_w * x[0] * x[2]);
  };
}

Conditions MadeBox::conditions() const {
  const double k_theta = solid.material.k_theta, k_e = solid.material.k_e, delta = solid.horizon * solid.spacing;
  const double e = std::exp(-1.0), root = std::sqrt(std::numbers::pi) * std::erf(1.0);
  const double D1 = 3.0 / 8 * root - 5.0 / 4 * e,
               D2 = (15.0 / 32 * root - 29.0 / 16 * e) * delta * delta;  // Sca23 53, 55
  const double A = k_theta / 3 + k_e / 5, B = k_theta / 3 + k_e / 15;
  const auto stress = [=, from = middle](const Eigen::Vector3d& at) {
    const Eigen::Vector3d x = at - from;
    const double u = made_u * x[1], w = made_w * x[0],
                 shear = made_u * k_e / 15 * x[0] + made_v * (k_e / 5 * x[0] * x[0] + k_e / 35 * D2 / D1);
    const double other = made_w * k_e / 15 * x[2];
    return Eigen::Matrix3d{{A * u + B * w, shear, other}, {shear, B * u + B * w, 0}, {other, 0, B * u + A * w}};
  };
  return {
      .held = [](const plate::SurfaceNode& n, int) { return n.side < 0 && n.axis == 0; },
      .displacement = field(),
      .traction = [=](const Eigen::Vector3d& at, const Eigen::Vector3d& n) { return Eigen::Vector3d(stress(at) * n); },
      .load =
          [=](const Eigen::Vector3d& at) {
            const double C = k_theta / 3 + 2 * k_e / 15;
            return Eigen::Vector3d(-made_w * C, -made_u * C - made_v * 2 * k_e / 5 * at[0], 0);
          }};
}

double MadeBox::uncorrected() const {
  const auto u = boundary_bodies::uncorrected(solid, conditions(), field());
  return errors(solid, u, field()).largest;
}

double MadeBox::corrected(int order, plate::FluxRule rule) const {
  constexpr int across = 2;
  const auto u = with_surface_nodes_mirrored(solid, order, rule, conditions(), across);
  return errors(solid, u, field()).largest;
}

}  // namespace boundary_bodies
