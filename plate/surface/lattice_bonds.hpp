#pragma once
#include <vector>
#include "plate/boundary/lattice_body.hpp"
#include "plate/model/discretization.hpp"
#include "plate/model/section.hpp"

namespace plate {

/// A bond of a point whose family is full; both ends give it the same.
struct LatticeBond {
  LatticeBody::Index away;  // to the other point [spacings]
  double mx, my, length;    // as in BondShape
  double D;                 // weight in the dilatation of either end (theory (12)) [1 / length]
  double curvature, shear;  // 4 A B, 4 A S: what both ends give together (theory (5))
};

/// The full family of the points of a lattice, with the lattice's constants (theory (9), (10)).
struct LatticeBonds {
  std::vector<LatticeBond> bonds;
  double dilatation_stiffness = 0;  // 2 A a [force length]
  double spacing = 1;               // [length]
  int reach = 0;                    // of the bonds along an axis [spacings]
};

/// The share of the cell so far away that is within the horizon.
struct CellShare {
  LatticeBody::Index away;
  double share;
};

/// Influence, shares of cells (lattice_fitted: the lattice is the local plate in homogeneous bending, theory (19)) and
/// the calibration of twist as the discretisation says.
LatticeBonds lattice_bonds(const Section& section, const Discretization& discretization);

/// The same with other shares of cells.
LatticeBonds lattice_bonds(const Section& section, const Discretization& discretization,
                           const std::vector<CellShare>& family);

}  // namespace plate
