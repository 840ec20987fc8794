#include "plate/bonds/levels/coarse_columns.hpp"

#include <algorithm>

namespace plate {
namespace {

constexpr int window = coarse_window;

int remainder(std::int32_t i) {
  return ((i % window) + window) % window;
}

}  // namespace

CoarseCells::CoarseCells(const std::vector<Transfer::Cell>& cells) {
  if (!cells.empty()) low_ = high_ = cells.front();
  for (const auto& c : cells) {
    low_.column = std::min(low_.column, c.column), low_.row = std::min(low_.row, c.row);
    high_.column = std::max(high_.column, c.column), high_.row = std::max(high_.row, c.row);
  }
  point_.assign(std::size_t(width()) * std::size_t(high_.row - low_.row + 1), -1);
  for (std::size_t i = 0; i < cells.size(); ++i) point_[index(cells[i])] = std::int32_t(i);
}

std::int32_t CoarseCells::at(const Transfer::Cell& c) const {
  const bool inside = c.column >= low_.column && c.column <= high_.column && c.row >= low_.row && c.row <= high_.row;
  return inside ? point_[index(c)] : -1;
}

void for_each_coarse_column(const Operator& L, const Transfer& transfer, const Constraints& constraints,
                            const CoarseCells& index, const CoarseVisit& visit) {
  const auto& cells = transfer.cells();
  const auto coarse_points = std::uint32_t(cells.size());
  State coarse(3, Eigen::Index(coarse_points)), fine(3, Eigen::Index(L.points()));
  Forces force;
  for (int color = 0; color < window * window; ++color)
    for (int component = 0; component < 3; ++component) {
      const int column = color % window, row = color / window;
      coarse.setZero(), fine.setZero();
      for (std::uint32_t i = 0; i < coarse_points; ++i)
        if (remainder(cells[i].column) == column && remainder(cells[i].row) == row)
          coarse(component, Eigen::Index(i)) = 1;
      transfer.prolong(coarse, fine);
      constraints.impose(fine);
      L.internal_force(fine, force);
      constraints.fold(force);
      constraints.fetch(force);
      transfer.restrict_to(coarse, force);
#pragma omp parallel for schedule(static)
      for (std::uint32_t i = 0; i < coarse_points; ++i) {
        // the point of this color in the window about i
        const auto& c = cells[i];
        const int x = remainder(column - c.column + window / 2) - window / 2,
                  y = remainder(row - c.row + window / 2) - window / 2;
        if (const auto j = index.at({c.column + x, c.row + y}); j >= 0)
          visit(i, std::uint32_t(j), component, -coarse.col(Eigen::Index(i)));
      }
    }
}

}  // namespace plate
