#pragma once
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/bonds/family_weights.hpp"
#include "plate/edges/lattice_body.hpp"
#include "plate/model/numerical_method.hpp"
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

/// Constructs lattice bonds with the shares of cells in `family`.
/// @throws std::invalid_argument  a family whose bonds are not in pairs of opposite ones, the first with the last
LatticeBonds lattice_bonds(const Section& section, const Discretization& discretization,
                           const std::vector<CellShare>& family);

/// Contribution of the energy of one end to a bond (theory (12)); zero where a crack crosses the bond.
struct BondHalf {
  double dilatation_couple;    // 2 A a D: of a unit dilatation of this end [force]
  double D, curvature, shear;  // as in LatticeBond, of this end alone
};

/// The families that cracks cut, with weights of their own; all others are full.
class CrackedFamilies {
public:
  CrackedFamilies() = default;  // no cracks
  /// `paths` in spacings from where the node (0, 0) is half a spacing from both axes. Fictitious nodes see cracks like
  /// others.
  CrackedFamilies(const LatticeBody& body, const LatticeBonds& bonds, const FamilyRule& rule,
                  const std::vector<geometry::CrackPath>& paths);

  /// Bonds of a node whose family is not full, in the order of the lattice's bonds; nothing where the family is full.
  const std::vector<BondHalf>* of(int node) const;
  bool broken(int node, std::size_t bond) const;

private:
  std::vector<int> of_;  // per node: which of the families, -1: full
  std::vector<std::vector<BondHalf>> families_;
};

/// Contribution of a node's energy to its bond `i`.
BondHalf half(const LatticeBonds& bonds, const CrackedFamilies& cuts, int node, std::size_t i);

/// A bond from a node as the energies of its two ends make it.
struct ActingBond {
  double mx, my, length;            // as in BondShape
  double curvature, shear;          // what both ends give together
  double D;                         // of the node's own energy
  double own_couple, other_couple;  // of unit dilatations of the node and of the other end [force]
};

/// Bond `i` of node k to node j.
ActingBond acting(const LatticeBonds& bonds, const CrackedFamilies& cuts, int k, int j, std::size_t i);

}  // namespace plate
