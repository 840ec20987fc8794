#pragma once
#include <variant>

#include "geometry/cells/rows/whole_lattice.hpp"
#include "plate/model/ranks/ranks.hpp"
#include "plate/model/state.hpp"

namespace plate {

struct Load;
struct Problem;

/// The points and cells of a plate; of one on a lattice that processes share only what tells them.
using WholeCells = std::variant<geometry::Tessellation, geometry::WholeLattice>;

std::size_t points_of(const WholeCells& whole);

/// What a process sees of the points and cells of a plate: all, or of a lattice those about its own part. All that it
/// asks of them near its own points, and of the supports, loads, soil and beams there, has the same bits as of the
/// whole.
struct SeenCells {
  geometry::Tessellation cells;
  std::vector<std::uint32_t> number;  // of its points in the whole, ascending; empty: all are here
  std::vector<int> owners;            // of its points
  geometry::CellBox own;              // about its own points

  std::uint32_t of_whole(std::uint32_t k) const { return number.empty() ? k : number[k]; }
};

/// @throws Refused  too few points, or rows of them, for so many processes
void require_parts(const WholeCells& whole, int processes);

/// Of this process. `whole`: cells are taken from it. `tips`: of which it may own some. `besides`: cells about which it
/// needs points too.
/// @throws Refused  too few points for so many processes
SeenCells seen_cells(const Ranks& all, const Problem& problem, WholeCells& whole,
                     const std::vector<geometry::Tip>& tips, const std::optional<geometry::CellBox>& besides = {});

/// The first point with squares all about it and its neighbours, with the cells that tell its weights; empty where
/// there is none.
geometry::Tessellation about_first_inside(const WholeCells& whole);

}  // namespace plate
