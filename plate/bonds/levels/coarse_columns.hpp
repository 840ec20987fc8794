#pragma once
#include "plate/bonds/levels/transfer.hpp"
#include "plate/formulation/constraints.hpp"

namespace plate {

/// Coarse points by their cells.
class CoarseCells {
public:
  explicit CoarseCells(const std::vector<Transfer::Cell>& cells);
  /// -1: none
  std::int32_t at(const Transfer::Cell& c) const;

private:
  std::int32_t width() const { return high_.column - low_.column + 1; }
  std::size_t index(const Transfer::Cell& c) const {
    return std::size_t(c.row - low_.row) * std::size_t(width()) + std::size_t(c.column - low_.column);
  }
  Transfer::Cell low_{0, 0}, high_{0, 0};
  std::vector<std::int32_t> point_;
};

/// Coarse cells across that one coarse point couples to.
constexpr int coarse_window = 5;

/// The stiffness R L R^T of the coarse points with the operator L, column by column: one product for all that are too
/// far from each other to meet in it. Calls visit(i, j, component, force on i of a unit of the component of j), from
/// several threads, each i in one of them. Where processes share the plate, right for their own points i.
using CoarseVisit = std::function<void(std::uint32_t i, std::uint32_t j, int component, const Eigen::Vector3d& K_ij)>;
void for_each_coarse_column(const Operator& L, const Transfer& transfer, const Constraints& constraints,
                            const CoarseCells& index, const CoarseVisit& visit);

}  // namespace plate
