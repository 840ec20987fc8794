#include "plate/galerkin/law.hpp"

#include <cmath>

namespace plate {

using geometry::Point;

GalerkinStiffness::GalerkinStiffness(const Section& section, double spacing_square, const GalerkinWeights& weights)
    : D(section.bending_stiffness()), nu(section.poisson), bending_residual(weights.bending_residual * D) {
  const double square = section.thickness * section.thickness, S = section.shear_stiffness();
  shear = S * square / (square + weights.shear_scaling * spacing_square);
  shear_residual = weights.shear_residual * S * square / (square + weights.residual_scaling * spacing_square);
}

FamilyStrains family_strains(const GalerkinFamilies& families, std::size_t k, const State& state) {
  FamilyStrains result;
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  const Point own = psi_of(state, k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    result.psi += (psi_of(state, j) - own) * bonds[i].gradient.transpose();
    result.gamma += bonds[i].gradient * bond_shear(state, k, j, families.families.vectors()[vector]);
  }
  return result;
}

double family_energy(const GalerkinFamilies& families, const Section& section, std::size_t k, const State& state) {
  const GalerkinStiffness stiffness(section, families.square(k));
  const FamilyStrains strains = family_strains(families, k, state);
  const Eigen::Matrix2d kappa = (strains.psi + strains.psi.transpose()) / 2;
  const double nu = stiffness.nu;
  double energy = families.areas[k] / 2 *
                  (stiffness.D * ((1 - nu) * kappa.squaredNorm() + nu * kappa.trace() * kappa.trace()) +
                   stiffness.shear * strains.gamma.squaredNorm());
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    const Point& x = families.families.vectors()[vector];
    const double length = x.norm();
    const Point n = x / length, r = (psi_of(state, j) - psi_of(state, k)) / length - strains.psi * n;
    const double along = r.dot(n), rho = bond_shear(state, k, j, x) / length - n.dot(strains.gamma);
    energy += bonds[i].share / 2 *
              (stiffness.bending_residual * ((1 - nu) / 2 * r.squaredNorm() + (1 + nu) / 2 * along * along) +
               stiffness.shear_residual * rho * rho);
  }
  return energy;
}

}  // namespace plate
