#pragma once
#include "geometry/lattice/partition.hpp"
#include "plate/bonds/family_operator.hpp"
#include "plate/formulation/boundary.hpp"

namespace plate {

/// The box of a rank, and the cells about it that it must see so that all that it computes of its owned points is
/// right: families of their neighbours' neighbours, images beyond edges.
struct PartOfLattice {
  geometry::Partition partition;
  geometry::CellBox own, seen;
  double about_tips;  // reach_about_tips()
};

/// Partition of the lattice of a plate among ranks.
/// @throws Refused  more processes than blocks of the lattice
geometry::Partition partition_of_lattice(const geometry::Outline& outline, const Discretization& discretization,
                                         int processes);
/// Width of the overlap beyond the box of a rank [cells].
long margin_of_part(const Discretization& discretization);

/// Part of the lattice that this rank holds; nothing where one process holds the whole plate.
/// @throws Refused  more processes than blocks of the lattice
std::optional<PartOfLattice> part_of_lattice(const Communicator& all, const geometry::Outline& outline,
                                             const Discretization& discretization);

/// Distance about a tip within which its rank knows the state and the forces, for intensity factors [spacings].
constexpr double reach_about_tips(double horizon_ratio) {
  return 28 + 2 * horizon_ratio;  // the largest ring is 24 wide, and its points look a horizon farther
}

/// Makes points of other ranks ghosts, and returns what is computed here: forces of owned points and of what follows
/// them. The surroundings of owned tips are ghosts, too.
OperatedPart operated(const PartOfLattice& part, Boundary& boundary, const geometry::Families& families,
                      const std::vector<geometry::Tip>& tips);

/// Points within `reach` of the box of a rank [spacings], at most reach_about_tips(). Nothing where one process holds
/// the whole plate.
std::optional<Surroundings> surroundings(const geometry::Outline& outline, const Discretization& discretization,
                                         const Boundary& boundary, double reach);

}  // namespace plate
