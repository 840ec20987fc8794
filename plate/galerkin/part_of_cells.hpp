#pragma once
#include <memory>
#include <variant>

#include "geometry/cells/global_lattice.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/state.hpp"

namespace plate {

struct MovingForces;
struct Problem;

/// The points and cells of a plate; of a distributed lattice, only its description.
using GlobalCells = std::variant<geometry::Tessellation, geometry::GlobalLattice>;

std::size_t points_of(const GlobalCells& whole);

/// Points and cells of a plate that a rank sees: all, or of a lattice those about its own part. All that the rank
/// computes of them near its owned points, and of the supports, loads, soil and beams there, is bitwise equal to the
/// values of the whole plate.
struct CellsWithOverlap {
  geometry::Tessellation cells;
  std::vector<std::uint32_t> number;  // of its points in the global plate, ascending; empty: all are here
  std::vector<int> owners;            // of its points
  geometry::CellBox own;              // about its owned points

  std::uint32_t global_number(std::uint32_t k) const { return number.empty() ? k : number[k]; }
};

/// @throws Refused  too few points, or rows of them, for so many processes
void require_parts(const GlobalCells& whole, int processes);

/// Points and cells that this rank sees. `whole`: cells are taken from it. `tips`: crack tips, of which the rank may
/// own some. `besides`: cells about which it needs points too.
/// @throws Refused  too few points for so many processes
CellsWithOverlap cells_with_overlap(const Communicator& all, const Problem& problem, GlobalCells& whole,
                                    const std::vector<geometry::Tip>& tips,
                                    const std::optional<geometry::CellBox>& besides = {});

/// The first point with squares all about it and its neighbours, with the cells that tell its weights; empty where
/// there is none.
geometry::Tessellation about_first_inside(const GlobalCells& whole);

/// Part that one rank holds of the cells of a distributed plate: its owned points, ghosts that their forces and plots
/// need, and ghosts about its crack tips.
struct PartOfCells {
  geometry::CellsPart part;                      // of the cells that it sees
  std::vector<std::uint32_t> number;             // of its points in the global plate, ascending
  std::vector<char> own;                         // of its points
  std::vector<std::uint32_t> column_block;       // 0 of ghosts; in which column block an owned one lies, from 1
  std::vector<Copy> copies;                      // the others
  std::shared_ptr<const HaloExchange> exchange;  // of these
  geometry::CellBox about;                       // where the point of the plate nearest to a place is known
};

/// Distance about a tip within which its rank knows the state, for intensity factors [length].
double reach_about_tip(const Problem& problem, const geometry::Tip& tip);
/// The widest window of displacement extrapolation that is seen about every tip [length].
double widest_window(const Problem& problem);

/// Part of the cells that this rank holds, for a plate with some supports, foundations and springs. `asked`: further
/// points that the rank sees and needs; empty: none. Collective: every rank must call it.
PartOfCells part_of_cells(const Communicator& all, const Problem& problem, const CellsWithOverlap& seen,
                          const ElasticSupports& elastic_supports, const std::vector<geometry::Tip>& tips,
                          const std::vector<char>& asked = {});

/// Restricts a quantity of all that a rank sees to the points of its part. `motions`: number of loads that may move
/// supports.
Boundary restricted(const Boundary& whole, const PartOfCells& part, std::size_t motions);
ElasticSupports restricted(const ElasticSupports& whole, const geometry::CellsPart& part);
Forces restricted(const Forces& whole, const geometry::CellsPart& part);
std::vector<double> restricted(const std::vector<double>& whole, const geometry::CellsPart& part);
MovingForces restricted(MovingForces whole, const PartOfCells& part);

}  // namespace plate
