#pragma once
#include "geometry/cells/tessellation.hpp"

namespace geometry {

/// Cells of a tessellation with their points, in global order.
struct CellsPart {
  Tessellation cells;
  std::vector<std::uint32_t> number;  // of its points in the global plate, ascending
};

/// Cells about the wanted points and about the points that share a cell with one that shares a cell with these: the
/// families of wanted points and of their neighbours have all their members then, and these all of the plate about
/// them. `wanted` [points of the global plate].
CellsPart cells_about(const Tessellation& whole, std::vector<char> wanted);

/// Columns of a lattice between two places where a row of points may be parted.
constexpr long columns_per_block = 256;

/// Column block in which a point lies, from 0. `x`: from the left end of the plate [length].
long column_block_at(double x, double spacing);
long column_block_of(const Tessellation& cells, std::size_t k);

/// Assigns every point to one of `parts`: about as many points each, by halving again and again along x or y. A lattice
/// is parted between rows, and between column blocks, so that a row of points is split in the same pieces for any
/// number of parts. The result depends on the cells alone; points at one place may be in different parts.
std::vector<int> shared_out(const Tessellation& cells, int parts);

}  // namespace geometry
