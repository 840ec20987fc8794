#include "plate/bonds/levels/two_level_plate.hpp"

#include <algorithm>

#include "plate/bonds/rows/lattice_operator.hpp"

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

/// A matrix of zeros that couples every coarse point to those in the window about it.
PointMatrix zeros(const std::vector<Transfer::Cell>& cells, const Cells& index) {
  PointMatrix result;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto begin = std::ptrdiff_t(result.row.size());
    for (int y = -window / 2; y <= window / 2; ++y)
      for (int x = -window / 2; x <= window / 2; ++x)
        if (const auto j = index.at({cells[i].column + x, cells[i].row + y}); j >= std::int32_t(i))
          result.row.push_back(std::uint32_t(j));
    std::sort(result.row.begin() + begin, result.row.end());
    result.first.push_back(result.row.size());
  }
  result.block.assign(result.row.size(), Eigen::Matrix3d::Zero());
  return result;
}

Forces diagonal_of(const PointMatrix& matrix) {
  Forces result(3, Eigen::Index(matrix.points()));
  for (std::size_t k = 0; k < matrix.points(); ++k)
    result.col(Eigen::Index(k)) = matrix.block[matrix.first[k]].diagonal();
  return result;
}

}  // namespace

TwoLevelPlate::TwoLevelPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                             const Discretization& discretization)
    : plate_(plate), constraints_(boundary.constraints), transfer_(plate.families(), boundary) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? weight / d : 0.0; });
  const LatticeOperator local(local_operator(plate, boundary, section, discretization));
  const PointMatrix matrix = coarse_stiffness(local);
  const Forces coarse_diagonal = diagonal_of(matrix);
  unknowns_ = unknowns(coarse_diagonal, elimination_order(matrix, coarse_diagonal));
  factor_ = factorised(of_unknowns(matrix, unknowns_));
}

/// R L R^T with the local plate L: one product with L for all coarse points that are too far from each other to meet
/// in it.
PointMatrix TwoLevelPlate::coarse_stiffness(const FamilyOperator& local) const {
  const auto& cells = transfer_.cells();
  const Cells index(cells);
  const auto coarse_points = Eigen::Index(cells.size());
  PointMatrix result = zeros(cells, index);
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
        if (j < std::int32_t(i)) continue;
        const auto begin = result.row.begin() + std::ptrdiff_t(result.first[std::size_t(i)]),
                   end = result.row.begin() + std::ptrdiff_t(result.first[std::size_t(i) + 1]);
        const auto at = std::lower_bound(begin, end, std::uint32_t(j)) - result.row.begin();
        result.block[std::size_t(at)].row(component) = -coarse.col(i).transpose();
      }
    }
  return without_rounding(result);
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
