#pragma once
#include "geometry/lattice/partition.hpp"
#include "plate/bonds/family_operator.hpp"
#include "plate/formulation/boundary.hpp"

namespace plate {

/// The box of a rank, and the cells about it that it must see so that all that it computes of its own
/// points is right: families of their neighbours' neighbours, images beyond edges.
struct PartOfLattice {
  geometry::Partition partition;
  geometry::CellBox own, seen;
  double about_tips;  // reach_about_tips()
};

/// How processes share out the lattice of a plate.
/// @throws Refused  more processes than blocks of the lattice
geometry::Partition partition_of_lattice(const geometry::Outline& outline, const Discretization& discretization,
                                         int processes);
/// How far beyond its box a process sees [cells].
long margin_of_part(const Discretization& discretization);

/// Nothing where one process holds the whole plate.
/// @throws Refused  more processes than blocks of the lattice
std::optional<PartOfLattice> part_of_lattice(const Communicator& all, const geometry::Outline& outline,
                                             const Discretization& discretization);

/// How far about a tip its process knows the state and the forces, for intensity factors [spacings].
constexpr double reach_about_tips(double horizon_ratio) {
  return 28 + 2 * horizon_ratio;  // the largest ring is 24 wide, and its points look a horizon farther
}

/// Ties the copies of the points of other processes to these, and returns what is computed here: forces of own points
/// and of what follows them. What is about own tips is copied.
OperatedPart operated(const PartOfLattice& part, Boundary& boundary, const geometry::Families& families,
                      const std::vector<geometry::Tip>& tips);

/// Points that a rank knows beside its owned points, where more are requested than their forces need.
struct Surroundings {
  std::vector<char> known;                       // points whose states are known
  std::shared_ptr<const HaloExchange> exchange;  // of those that others own
};

/// All that is within `reach` of the box of a process [spacings], at most reach_about_tips(). Nothing where one process
/// holds the whole plate.
std::optional<Surroundings> surroundings(const geometry::Outline& outline, const Discretization& discretization,
                                         const Boundary& boundary, double reach);

}  // namespace plate
