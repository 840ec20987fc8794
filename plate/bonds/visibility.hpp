#pragma once
#include "plate/formulation/bond_law.hpp"
#include "plate/formulation/boundary.hpp"

namespace plate {

/// Families without the bonds that cross cracks, mirror images of the cracks included. `paths` in lattice
/// units. A crack that is there from the start costs nothing later: its bonds are not in the list.
geometry::Families without_crossing_bonds(const Boundary& boundary, const geometry::Families& families,
                                          const std::vector<geometry::CrackPath>& paths, double horizon_ratio);

/// Share of the weight of each plate point's family that `remaining` lost against `whole`: 0 away from cracks.
std::vector<double> cut_share(const geometry::Families& whole, const geometry::Families& remaining,
                              const std::vector<BondShape>& shapes, std::size_t plate_points);

}  // namespace plate
