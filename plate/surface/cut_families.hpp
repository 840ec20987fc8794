#pragma once
#include "geometry/shape/crack_path.hpp"
#include "plate/bonds/parameters/family_rule.hpp"
#include "plate/surface/lattice_bonds.hpp"

namespace plate {

/// What the energy of one end gives to a bond (theory (12)); nothing where a crack severs it.
struct BondHalf {
  double dilatation_couple;    // 2 A a D: of a unit dilatation of this end [force]
  double D, curvature, shear;  // as in LatticeBond, of this end alone
};

/// The families that cracks cut, with weights of their own; all others are full.
class CutFamilies {
public:
  CutFamilies() = default;  // no cracks
  /// `paths` in spacings from where the node (0, 0) is half a spacing from both axes. Fictitious nodes see cracks like
  /// others.
  CutFamilies(const LatticeBody& body, const LatticeBonds& bonds, const FamilyRule& rule,
              const std::vector<geometry::CrackPath>& paths);

  /// Nothing where the family of the node is full; else in the order of the lattice's bonds.
  const std::vector<BondHalf>* of(int node) const;
  bool severed(int node, std::size_t bond) const;

private:
  std::vector<int> of_;  // per node: which of the families, -1: full
  std::vector<std::vector<BondHalf>> families_;
};

/// Of bond `i` of a node.
BondHalf half(const LatticeBonds& bonds, const CutFamilies& cuts, int node, std::size_t i);

/// A bond from a node as the energies of its two ends make it.
struct ActingBond {
  double mx, my, length;            // as in BondShape
  double curvature, shear;          // what both ends give together
  double D;                         // of the node's own energy
  double own_couple, other_couple;  // of unit dilatations of the node and of the other end [force]
};

/// Bond `i` of node k to node j.
ActingBond acting(const LatticeBonds& bonds, const CutFamilies& cuts, int k, int j, std::size_t i);

}  // namespace plate
