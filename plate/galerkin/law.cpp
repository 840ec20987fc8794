#include "plate/galerkin/law.hpp"

#include <algorithm>
#include <cmath>

namespace plate {

using geometry::Point;

namespace {

/// Stiffness against equal curvatures over that against opposite ones, at most 1: (1 + nu) / (1 - nu) where nu < 0.
/// There the residuals of bonds, which are mostly of the second kind, would hide a field that is mostly of the first.
double softness(const Eigen::Matrix3d& bending) {
  const double sum = bending(0, 0) + bending(1, 1), mixed = 2 * bending(0, 1);
  return std::min(1.0, (sum + mixed) / (sum - mixed));
}

}  // namespace

GalerkinStiffness::GalerkinStiffness(const LocalSection& section, double spacing_square, const GalerkinWeights& weights)
    : bending(section.bending), bending_residual(softness(section.bending) * weights.bending_residual) {
  const double square = section.thickness * section.thickness;
  shear = square / (square + weights.shear_scaling * spacing_square) * section.shear;
  shear_residual =
      weights.shear_residual * square / (square + weights.residual_scaling * spacing_square) * section.shear;
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

double family_energy(const GalerkinFamilies& families, const LocalSection& section, std::size_t k, const State& state) {
  const GalerkinStiffness stiffness(section, families.square(k));
  const FamilyStrains strains = family_strains(families, k, state);
  const Eigen::Vector3d kappa(strains.psi(0, 0), strains.psi(1, 1), strains.psi(0, 1) + strains.psi(1, 0));
  double energy = families.areas[k] / 2 *
                  (kappa.dot(stiffness.bending * kappa) + strains.gamma.dot(stiffness.shear * strains.gamma));
  const auto family = families.families[k];
  const auto* bonds = families.of(k);
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto [j, vector] = family[i];
    const Point& x = families.families.vectors()[vector];
    const double length = x.norm();
    const Point n = x / length, r = (psi_of(state, j) - psi_of(state, k)) / length - strains.psi * n;
    const double rho = bond_shear(state, k, j, x) / length - n.dot(strains.gamma);
    energy += bonds[i].share / 2 *
              (stiffness.bending_residual * r.dot(along(stiffness.bending, n) * r) +
               n.dot(stiffness.shear_residual * n) * rho * rho);
  }
  return energy;
}

}  // namespace plate
