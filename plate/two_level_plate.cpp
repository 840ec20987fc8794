#include "plate/two_level_plate.hpp"

#include <algorithm>

#include "plate/lattice_operator.hpp"

namespace plate {
namespace {

constexpr int sweeps = 2;       // before and after
constexpr double weight = 0.6;  // of a sweep
constexpr int window = 5;       // coarse cells across that one coarse point couples to

/// Coarse points by their cells.
class Cells {
public:
  explicit Cells(const std::vector<Transfer::Cell>& cells) {
    for (const auto& c : cells) {
      low_.column = std::min(low_.column, c.column), low_.row = std::min(low_.row, c.row);
      high_.column = std::max(high_.column, c.column), high_.row = std::max(high_.row, c.row);
    }
    point_.assign(std::size_t(width()) * std::size_t(high_.row - low_.row + 1), -1);
    for (std::size_t i = 0; i < cells.size(); ++i) point_[index(cells[i])] = std::int32_t(i);
  }
  /// -1: none
  std::int32_t at(const Transfer::Cell& c) const {
    const bool inside = c.column >= low_.column && c.column <= high_.column && c.row >= low_.row && c.row <= high_.row;
    return inside ? point_[index(c)] : -1;
  }

private:
  std::int32_t width() const { return high_.column - low_.column + 1; }
  std::size_t index(const Transfer::Cell& c) const {
    return std::size_t(c.row - low_.row) * std::size_t(width()) + std::size_t(c.column - low_.column);
  }
  Transfer::Cell low_{0, 0}, high_{0, 0};
  std::vector<std::int32_t> point_;
};

int remainder(std::int32_t i) {
  return ((i % window) + window) % window;
}

/// The diagonal of columns of a lower triangle, one column for every degree of freedom.
Forces diagonal_of(const std::vector<MatrixColumn>& columns) {
  Forces result(3, Eigen::Index(columns.size() / 3));
  for (std::size_t dof = 0; dof < columns.size(); ++dof) {
    const auto& column = columns[dof];
    at_dof(result, dof) = !column.empty() && column.front().first == std::int32_t(dof) ? column.front().second : 0;
  }
  return result;
}

/// Drops what is zero but for rounding: it would fill the factor.
void without_rounding(std::vector<MatrixColumn>& columns) {
  constexpr double rounding = 1e-12;
  const Forces diagonal = diagonal_of(columns);
#pragma omp parallel for schedule(static)
  for (std::size_t dof = 0; dof < columns.size(); ++dof)
    std::erase_if(columns[dof], [&](const auto& entry) {
      const double scale = at_dof(diagonal, dof) * at_dof(diagonal, std::size_t(entry.first));
      return entry.second * entry.second <= rounding * rounding * scale;
    });
}

/// Pairs of points that the columns couple, lower triangle.
Eigen::SparseMatrix<double> graph_of(const std::vector<MatrixColumn>& columns) {
  std::vector<MatrixColumn> result(columns.size() / 3);
  for (std::size_t dof = 0; dof < columns.size(); ++dof)
    for (const auto& [row, value] : columns[dof]) result[dof / 3].emplace_back(row / 3, 1);
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k].emplace_back(std::int32_t(k), 1);
    std::sort(result[k].begin(), result[k].end());
    result[k].erase(std::unique(result[k].begin(), result[k].end()), result[k].end());
  }
  return compressed(result);
}

}  // namespace

TwoLevelPlate::TwoLevelPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                             const Discretization& discretization)
    : plate_(plate), constraints_(boundary.constraints), transfer_(plate.families(), boundary) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? weight / d : 0.0; });
  const LatticeOperator local(local_operator(plate, boundary, section, discretization));
  const auto columns = coarse_stiffness(local);
  const Forces coarse_diagonal = diagonal_of(columns);
  unknowns_ = unknowns(coarse_diagonal);
  std::vector<MatrixColumn> free;
  for (const auto dof : unknowns_.dof) {
    free.emplace_back();
    for (const auto& [row, value] : columns[dof])
      if (const auto index = unknowns_.index[std::size_t(row)]; index >= 0) free.back().emplace_back(index, value);
  }
  factor_ = factorised(compressed(free), order_of(unknowns_, graph_of(columns)));
}

/// Columns of R L R^T with the local plate L, lower triangle: one product with L for all coarse points that are too far
/// from each other to meet in it.
std::vector<MatrixColumn> TwoLevelPlate::coarse_stiffness(const FamilyOperator& local) const {
  const auto& cells = transfer_.cells();
  const Cells index(cells);
  const auto coarse_points = Eigen::Index(cells.size());
  std::vector<MatrixColumn> columns(std::size_t(3 * coarse_points));
  State coarse(3, coarse_points), fine(3, Eigen::Index(local.points()));
  Forces force;
  for (int color = 0; color < window * window; ++color)
    for (int component = 0; component < 3; ++component) {
      const int column = color % window, row = color / window;
      coarse.setZero(), fine.setZero();
      for (Eigen::Index i = 0; i < coarse_points; ++i)
        if (remainder(cells[std::size_t(i)].column) == column && remainder(cells[std::size_t(i)].row) == row)
          coarse(component, i) = 1;
      transfer_.prolong(coarse, fine);
      constraints_.impose(fine);
      local.internal_force(fine, force);
      constraints_.fold(force);
      transfer_.restrict_to(coarse, force);
#pragma omp parallel for schedule(static)
      for (Eigen::Index i = 0; i < coarse_points; ++i) {
        // the point of this color in the window about i; what i has of it, it has of i
        const auto& c = cells[std::size_t(i)];
        const int x = remainder(column - c.column + window / 2) - window / 2,
                  y = remainder(row - c.row + window / 2) - window / 2;
        const auto j = index.at({c.column + x, c.row + y});
        for (int d = 0; j >= 0 && d < 3; ++d)
          if (const double value = -coarse(d, i); value != 0 && 3 * j + component >= std::int32_t(3 * i) + d)
            columns[std::size_t(3 * i + d)].emplace_back(3 * j + component, value);
      }
    }
  for (auto& column : columns) std::sort(column.begin(), column.end());
  without_rounding(columns);
  return columns;
}

void TwoLevelPlate::apply(const Forces& residual, State& result) const {
  const auto subtract_product = [&] {  // rest = residual - K result
    constraints_.impose(result);
    plate_.internal_force(result, product_);
    constraints_.fold(product_);
    rest_ = residual + product_;
  };
  result = inverse_diagonal_.cwiseProduct(residual);
  for (int i = 1; i < sweeps; ++i) {
    subtract_product();
    result += inverse_diagonal_.cwiseProduct(rest_);
  }
  subtract_product();
  transfer_.restrict_to(coarse_force_, rest_);
  const Eigen::MatrixXd solution = factor_->solve(gathered(unknowns_, coarse_force_));
  coarse_.setZero(3, coarse_force_.cols());
  for (Eigen::Index u = 0; u < solution.rows(); ++u) at_dof(coarse_, unknowns_.dof[std::size_t(u)]) = solution(u, 0);
  transfer_.prolong(coarse_, result);
  for (int i = 0; i < sweeps; ++i) {
    subtract_product();
    result += inverse_diagonal_.cwiseProduct(rest_);
  }
}

}  // namespace plate
