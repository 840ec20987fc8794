#pragma once
#include <vector>
#include "plate/bonds/parameters/position_aware.hpp"
#include "plate/boundary/lattice_body.hpp"
#include "plate/model/discretization.hpp"
#include "plate/model/section.hpp"

namespace plate {

/// A bond of a point whose family is full; both ends give it the same.
struct LatticeBond {
  LatticeBody::Index away;  // to the other point [spacings]
  double mx, my, length;    // as in BondShape
  double weight;            // omega A h beta [length^3]
  double D;                 // weight in the dilatation of either end (theory (12)) [1 / length]
  double curvature, shear;  // 4 A B, 4 A S: what both ends give together (theory (5))
};

/// The full family of the points of a lattice, the bonds in any order of which the reverse has opposite directions.
struct LatticeBonds {
  std::vector<LatticeBond> bonds;
  double dilatation_stiffness = 0;  // 2 A a [force length]
  double spacing = 1;               // [length]
  int reach = 0;                    // of the bonds along an axis [spacings]

  std::size_t opposite(std::size_t i) const { return bonds.size() - 1 - i; }
};

FamilyBond family_bond(const LatticeBonds& lattice, std::size_t i);

/// The share of the cell so far away that is within the horizon.
struct CellShare {
  LatticeBody::Index away;
  double share;
};

/// Influence, shares of cells and weights as the discretisation says: by its surface correction, of a full family. With
/// position-aware weights, or the arbitrary horizon's and lattice_fitted shares, the lattice is the local plate in
/// homogeneous bending (theory (13), (19)).
LatticeBonds lattice_bonds(const Section& section, const Discretization& discretization);

/// The same with other shares of cells.
/// @throws std::invalid_argument  a family whose bonds are not in pairs of opposite ones, the first with the last
LatticeBonds lattice_bonds(const Section& section, const Discretization& discretization,
                           const std::vector<CellShare>& family);

}  // namespace plate
