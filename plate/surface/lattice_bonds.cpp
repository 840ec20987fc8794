#include "plate/surface/lattice_bonds.hpp"

#include <stdexcept>
#include "plate/bonds/parameters/family_rule.hpp"
#include "plate/bonds/parameters/influence.hpp"

namespace plate {

FamilyBond family_bond(const LatticeBonds& lattice, std::size_t i) {
  const auto& bond = lattice.bonds[i];
  return {lattice.spacing * bond.away.head<2>().cast<double>(), bond.weight};
}

LatticeBonds lattice_bonds(const Section& section, const Discretization& d, const std::vector<CellShare>& family) {
  const double area = d.spacing * d.spacing;
  LatticeBonds result{{}, 0, d.spacing, 0};
  std::vector<FamilyBond> bonds;
  for (std::size_t i = 0; i < family.size(); ++i) {
    const auto& [away, share] = family[i];
    if ((away + family[family.size() - 1 - i].away).matrix().any())
      throw std::invalid_argument("a family whose reverse does not have opposite directions");
    const geometry::Point xi = d.spacing * away.head<2>().cast<double>();
    const double length = xi.norm(), weight = influence(d.influence, length, d.horizon()) * share * section.thickness;
    result.bonds.push_back({away, xi.y() / length, -xi.x() / length, length, weight * area, 0, 0, 0});
    result.reach = std::max(result.reach, away.abs().maxCoeff());
    bonds.push_back(family_bond(result, i));
  }
  const FamilyWeights weights = FamilyRule(section, d)(bonds);
  result.dilatation_stiffness = 2 * area * weights.a;
  for (std::size_t i = 0; i < bonds.size(); ++i) {
    auto& bond = result.bonds[i];
    const auto& [D, B, S] = weights.bonds[i];
    bond.D = D, bond.curvature = 4 * area * B, bond.shear = 4 * area * S;
  }
  return result;
}

LatticeBonds lattice_bonds(const Section& section, const Discretization& d) {
  std::vector<CellShare> family;
  for (const auto& xi : full_family(d))
    family.push_back(
        {{int(std::lround(xi.x() / d.spacing)), int(std::lround(xi.y() / d.spacing)), 0}, volume_share(d, xi)});
  return lattice_bonds(section, d, family);
}

}  // namespace plate
