#include "plate/edges/lattice_bonds.hpp"

#include <map>
#include <stdexcept>

#include "plate/bonds/family_weights.hpp"
#include "plate/bonds/horizon_parameters.hpp"

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

namespace {

using geometry::Point;

Point place(const LatticeBody::Index& node) {
  return node.head<2>().cast<double>() + 0.5;
}

std::vector<BondHalf> halves(const LatticeBonds& lattice, const FamilyRule& rule, const std::vector<bool>& broken) {
  std::vector<FamilyBond> left;
  for (std::size_t i = 0; i < broken.size(); ++i)
    if (!broken[i]) left.push_back(family_bond(lattice, i));
  const FamilyWeights weights = rule(left);
  const double area = lattice.spacing * lattice.spacing;
  std::vector<BondHalf> result(broken.size(), {0, 0, 0, 0});
  for (std::size_t i = 0, next = 0; i < broken.size(); ++i) {
    if (broken[i]) continue;
    const auto& [D, B, S] = weights.bonds[next++];
    result[i] = {2 * area * weights.a * D, D, 2 * area * B, 2 * area * S};
  }
  return result;
}

}  // namespace

CrackedFamilies::CrackedFamilies(const LatticeBody& body, const LatticeBonds& lattice, const FamilyRule& rule,
                                 const std::vector<geometry::CrackPath>& paths)
    : of_(std::size_t(body.count()), -1) {
  std::map<std::vector<bool>, int> known;
  const double reach = rule.discretization().horizon_ratio;
  for (std::size_t k = 0; k < of_.size(); ++k) {
    const Point p = place(body.nodes[k]);
    std::vector<bool> broken(lattice.bonds.size(), false);
    for (const auto& path : paths) {
      if (geometry::distance(path.vertices, p) > reach) continue;
      for (std::size_t i = 0; i < broken.size(); ++i)
        if (geometry::separates(path, p, place(body.nodes[k] + lattice.bonds[i].away))) broken[i] = true;
    }
    if (std::ranges::find(broken, true) == broken.end()) continue;
    const auto [entry, fresh] = known.try_emplace(broken, int(families_.size()));
    if (fresh) families_.push_back(halves(lattice, rule, broken));
    of_[k] = entry->second;
  }
}

const std::vector<BondHalf>* CrackedFamilies::of(int node) const {
  const int family = of_.empty() ? -1 : of_[std::size_t(node)];
  return family < 0 ? nullptr : &families_[std::size_t(family)];
}

bool CrackedFamilies::broken(int node, std::size_t bond) const {
  const auto* cut = of(node);
  return cut && (*cut)[bond].curvature == 0;
}

BondHalf half(const LatticeBonds& lattice, const CrackedFamilies& cuts, int node, std::size_t i) {
  if (const auto* cut = cuts.of(node)) return (*cut)[i];
  const auto& bond = lattice.bonds[i];
  return {lattice.dilatation_stiffness * bond.D, bond.D, bond.curvature / 2, bond.shear / 2};
}

ActingBond acting(const LatticeBonds& lattice, const CrackedFamilies& cuts, int k, int j, std::size_t i) {
  const BondHalf own = half(lattice, cuts, k, i), other = half(lattice, cuts, j, lattice.opposite(i));
  const auto& bond = lattice.bonds[i];
  return {bond.mx,
          bond.my,
          bond.length,
          own.curvature + other.curvature,
          own.shear + other.shear,
          own.D,
          own.dilatation_couple,
          other.dilatation_couple};
}

}  // namespace plate
