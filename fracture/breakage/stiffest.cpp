#include <algorithm>
#include <cmath>
#include <tuple>

#include "fracture/breakage/damaged_plate.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/model/reduction.hpp"

namespace fracture {
namespace {

// Families beside clean cracks at 0 to 45 degrees to the lattice: measured 1.17 of the stiffness of a full family,
// single bonds 2.26.
constexpr double stiffest_family = 1.2, stiffest_bond = 2.4;

/// A full family of a process: its size and cell, what it does in all, and by bond vector [spacings].
struct Full {
  long size = 0, column = 0, row = 0;
  double bending = 0, shear = 0;

  auto rank() const { return std::tuple(-size, row, column); }
};
struct FullBond {
  double x, y, B, S;
};

}  // namespace

double bending_stiffness(double a, std::span<const plate::BondWeights> bonds) {
  double sum = 0, square = 0;
  for (const auto& bond : bonds) sum += bond.B, square += bond.D * bond.D;
  return sum + std::abs(a) * square;
}

double shear_stiffness(std::span<const plate::BondWeights> bonds) {
  double sum = 0;
  for (const auto& bond : bonds) sum += bond.S;
  return sum;
}

Stiffest stiffest(const plate::FamilyOperator& plate, const plate::Boundary& boundary) {
  const auto& families = plate.families();
  const auto& weights = plate.weights();
  const double spacing = boundary.cloud.units.spacing;
  Full full;
  std::vector<FullBond> bonds;
  std::size_t found = 0;
  for (std::size_t k = 0; k < plate.points(); ++k)
    if (boundary.active[k] && boundary.owns(k) && long(families[k].size()) > full.size)
      found = k, full.size = long(families[k].size());
  if (full.size > 0) {
    const std::span own(&weights.of(found, 0), families[found].size());
    const auto [column, row] = geometry::cell_of(boundary.lattice[found]);
    full = {full.size, column, row, bending_stiffness(weights.a[weights.kind[found]], own), shear_stiffness(own)};
    for (std::size_t i = 0; i < own.size(); ++i) {
      const geometry::Point vector = families.vectors()[families[found][i].vector_id] / spacing;
      bonds.push_back({vector.x(), vector.y(), own[i].B, own[i].S});
    }
  }
  const auto every = plate::gathered(boundary.map, std::vector{full});
  const auto first = std::ranges::min_element(every, {}, &Full::rank);
  full = *first;
  bonds = plate::gathered(boundary.map, first - every.begin() == boundary.map.rank() ? bonds : std::vector<FullBond>{});
  Stiffest result{stiffest_family * full.bending, stiffest_family * full.shear, {}};
  for (const auto& vector : families.vectors()) {
    const geometry::Point x = vector / spacing;
    const auto same = std::ranges::find_if(
        bonds, [&](const FullBond& bond) { return std::abs(bond.x - x.x()) + std::abs(bond.y - x.y()) < 0.01; });
    result.bonds.push_back(same == bonds.end()
                               ? plate::BondWeights{INFINITY, INFINITY, INFINITY}
                               : plate::BondWeights{0, stiffest_bond * same->B, stiffest_bond * same->S});
  }
  return result;
}

}  // namespace fracture
