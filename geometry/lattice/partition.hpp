#pragma once
#include <vector>

#include "geometry/lattice/cloud.hpp"

namespace geometry {

/// A lattice shared out among processes: to each a box of whole blocks of cells. Blocks lie where they lie whatever
/// the number of processes, so that what is computed by blocks is the same for any.
class Partition {
public:
  /// Cells of a block: rows of points are long, as forces are fastest along them.
  static constexpr Cell block{256, 16};

  /// Constructs a partition with about as many cells of the plate in each box. More parts than blocks: some have none.
  /// `outline` in lattice units.
  Partition(const Outline& outline, int parts);

  std::size_t blocks() const { return owners_.size(); }
  const CellBox& box(int part) const { return boxes_[std::size_t(part)]; }
  /// The part of a cell of the outline's bounding box.
  int owner(const Cell& cell) const { return owners_[index(block_of(cell))]; }
  /// The part of the block nearest to any cell.
  int nearest_owner(const Cell& cell) const;
  /// A number of the block of any cell, near the plate or in it.
  std::uint32_t number(const Cell& cell) const;

private:
  static Cell block_of(const Cell& cell);
  std::size_t index(const Cell& place) const { return std::size_t(place[1] * counts_[0] + place[0]); }
  void share_out(const CellBox& blocks, const std::vector<double>& work, int first, int parts);

  Cell counts_{0, 0};  // blocks
  std::vector<CellBox> boxes_;
  std::vector<int> owners_;  // of blocks
};

}  // namespace geometry
