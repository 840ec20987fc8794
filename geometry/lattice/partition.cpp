#include "geometry/lattice/partition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geometry {
namespace {

long blocks_of(double cells, long size) {
  return std::max(1L, static_cast<long>(std::ceil(std::ceil(cells) / double(size))));
}

/// Share of a block that lies in the plate, of 8 x 4 places.
double filled(const Outline& outline, const Cell& place) {
  constexpr int across = 8, up = 4;
  int inside = 0;
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < across; ++i) {
      const Point u((double(place[0]) + (i + 0.5) / across) * double(Partition::block[0]),
                    (double(place[1]) + (j + 0.5) / up) * double(Partition::block[1]));
      inside += contains(outline, u);
    }
  return std::max(inside, 1) / double(across * up);
}

double sum(const CellBox& blocks, const std::vector<double>& work, long columns) {
  double result = 0;
  for (long row = blocks.low[1]; row < blocks.high[1]; ++row)
    for (long column = blocks.low[0]; column < blocks.high[0]; ++column)
      result += work[std::size_t(row * columns + column)];
  return result;
}

}  // namespace

Partition::Partition(const Outline& outline, int parts) {
  const Point size = bounding_box(outline).second;
  counts_ = {blocks_of(size.x(), block[0]), blocks_of(size.y(), block[1])};
  std::vector<double> work;
  for (long row = 0; row < counts_[1]; ++row)
    for (long column = 0; column < counts_[0]; ++column) work.push_back(filled(outline, {column, row}));
  boxes_.assign(std::size_t(parts), {});
  owners_.assign(work.size(), 0);
  share_out({{0, 0}, counts_}, work, 0, parts);
}

/// Halves a box of blocks in proportion to the parts, where that is nearest to equal work, and short.
void Partition::share_out(const CellBox& blocks, const std::vector<double>& work, int first, int parts) {
  if (parts == 1 || (blocks.side(0) == 1 && blocks.side(1) == 1)) {
    boxes_[std::size_t(first)] = {{blocks.low[0] * block[0], blocks.low[1] * block[1]},
                                  {blocks.high[0] * block[0], blocks.high[1] * block[1]}};
    for (long row = blocks.low[1]; row < blocks.high[1]; ++row)
      for (long column = blocks.low[0]; column < blocks.high[0]; ++column) owners_[index({column, row})] = first;
    return;
  }
  const int lower_parts = parts / 2;
  const double all = sum(blocks, work, counts_[0]);
  double least = std::numeric_limits<double>::infinity();
  CellBox lower = blocks, upper = blocks;
  for (const std::size_t axis : {0, 1})
    for (long cut = blocks.low[axis] + 1; cut < blocks.high[axis]; ++cut) {
      CellBox below = blocks, above = blocks;
      below.high[axis] = above.low[axis] = cut;
      const double apart = std::abs(sum(below, work, counts_[0]) / all - double(lower_parts) / parts);
      const double border = double(blocks.side(1 - axis) * block[1 - axis]) /
                            double(blocks.side(0) * block[0] + blocks.side(1) * block[1]);
      constexpr double share_of_border = 0.05;  // what an equal share of the work is worth beside a short border
      if (const double cost = apart + share_of_border * border; cost < least)
        least = cost, lower = below, upper = above;
    }
  share_out(lower, work, first, lower_parts);
  share_out(upper, work, first + lower_parts, parts - lower_parts);
}

Cell Partition::block_of(const Cell& cell) {
  const auto floored = [](long a, long b) { return a >= 0 ? a / b : -((-a + b - 1) / b); };
  return {floored(cell[0], block[0]), floored(cell[1], block[1])};
}

int Partition::nearest_owner(const Cell& cell) const {
  const Cell place = block_of(cell);
  return owners_[index({std::clamp(place[0], 0L, counts_[0] - 1), std::clamp(place[1], 0L, counts_[1] - 1)})];
}

std::uint32_t Partition::number(const Cell& cell) const {
  const Cell place = block_of(cell);  // a block more on every side
  return std::uint32_t((place[1] + 1) * (counts_[0] + 2) + place[0] + 1);
}

}  // namespace geometry
