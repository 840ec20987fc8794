#include "plate/two_level_plate.hpp"

#include <map>

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

/// The graph of points of a matrix of unknowns, lower triangle.
Eigen::SparseMatrix<double> graph_of(const Eigen::SparseMatrix<double>& matrix, const Unknowns& unknowns,
                                     std::size_t points) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < points; ++k) entries.emplace_back(k, k, 1);
  for (Eigen::Index u = 0; u < matrix.outerSize(); ++u)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, u); it; ++it) {
      const auto j = unknowns.dof[std::size_t(u)] / 3, i = unknowns.dof[std::size_t(it.row())] / 3;
      if (i != j && unknowns.dof[std::size_t(u)] % 3 == 0) entries.emplace_back(std::max(i, j), std::min(i, j), 1);
    }
  Eigen::SparseMatrix<double> result{Eigen::Index(points), Eigen::Index(points)};
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

TwoLevelPlate::TwoLevelPlate(const FamilyOperator& plate, const Boundary& boundary, const Section& section,
                             const Discretization& discretization)
    : plate_(plate), constraints_(boundary.constraints), transfer_(plate.families(), boundary) {
  const Forces diagonal = folded_diagonal(plate, constraints_);
  inverse_diagonal_ = diagonal.unaryExpr([](double d) { return d > 0 ? weight / d : 0.0; });
  const LatticeOperator local(local_operator(plate, boundary, section, discretization));
  const Eigen::SparseMatrix<double> all = coarse_stiffness(local);
  Forces coarse_diagonal(3, Eigen::Index(transfer_.coarse_points()));
  for (Eigen::Index dof = 0; dof < all.cols(); ++dof) at_dof(coarse_diagonal, std::size_t(dof)) = all.coeff(dof, dof);
  constexpr double rounding = 1e-24;
  unknowns_ = unknowns(coarse_diagonal);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < all.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(all, column); it; ++it) {
      const auto i = unknowns_.index[std::size_t(it.row())], j = unknowns_.index[std::size_t(column)];
      const double scale = at_dof(coarse_diagonal, std::size_t(it.row())) * at_dof(coarse_diagonal, std::size_t(column));
      if (i >= 0 && j >= 0 && it.value() * it.value() > rounding * scale) entries.emplace_back(i, j, it.value());
    }
  Eigen::SparseMatrix<double> matrix(unknowns_.size(), unknowns_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_ = factorised(matrix, order_of(unknowns_, graph_of(matrix, unknowns_, transfer_.coarse_points())));
}

/// R L R^T of the local plate L, lower triangle: one product with L for all coarse points that are too far from each
/// other to meet in it.
Eigen::SparseMatrix<double> TwoLevelPlate::coarse_stiffness(const FamilyOperator& local) const {
  const auto& cells = transfer_.cells();
  const Cells index(cells);
  const auto points = Eigen::Index(local.points()), coarse_points = Eigen::Index(cells.size());
  std::vector<std::vector<std::pair<std::int32_t, double>>> rows(std::size_t(3 * coarse_points));
  State coarse(3, coarse_points), fine(3, points);
  Forces force;
  for (int color = 0; color < window * window; ++color)
    for (int component = 0; component < 3; ++component) {
      coarse.setZero(), fine.setZero();
      const int column = color % window, row = color / window;
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
        // the point of this color in the window about i
        const auto& c = cells[std::size_t(i)];
        const int x = remainder(column - c.column + window / 2) - window / 2,
                  y = remainder(row - c.row + window / 2) - window / 2;
        const auto j = index.at({c.column + x, c.row + y});
        for (int d = 0; j >= 0 && d < 3; ++d)
          if (const double value = -coarse(d, i); value != 0 && 3 * i + d >= 3 * Eigen::Index(j) + component)
            rows[std::size_t(3 * i + d)].emplace_back(3 * j + component, value);
      }
    }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (const auto& [c, value] : rows[r]) entries.emplace_back(int(r), c, value);
  Eigen::SparseMatrix<double> result(3 * coarse_points, 3 * coarse_points);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
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
