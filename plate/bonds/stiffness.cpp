#include "plate/bonds/stiffness.hpp"

#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {
namespace {

Eigen::Vector2d direction(const PatternBond& bond) {
  return {bond.mx, bond.my};
}

/// The blocks of one column at a time, by their rows.
class ColumnBlocks {
public:
  explicit ColumnBlocks(PointMatrix& matrix) : matrix_(matrix), place_(matrix.points()) {}

  void begin(std::uint32_t k) {
    k_ = k;
    for (auto b = matrix_.first[k]; b < matrix_.first[k + 1]; ++b) place_[matrix_.row[b]] = std::uint32_t(b);
  }
  /// Block of a row of the current column, from the diagonal on (row >= k).
  Eigen::Matrix3d& at(std::uint32_t row) { return matrix_.block[place_[row]]; }
  bool has(std::uint32_t row) const { return row >= k_; }

private:
  PointMatrix& matrix_;
  std::uint32_t k_ = 0;
  std::vector<std::uint32_t> place_;
};

/// Bending and shear of the bonds of point k.
void add_bonds(const PointBonds& bonds, std::uint32_t k, ColumnBlocks& column) {
  for (const auto& bond : bonds.of(k)) {
    const auto j = bond.neighbour(k);
    const Eigen::Vector2d m = direction(bond), half = bond.length / 2 * m;
    // shear: w_j - w_k - length / 2 m (theta_j + theta_k); curvature: m (theta_j - theta_k)
    const Eigen::Vector3d own(-1, -half.x(), -half.y()), other(1, -half.x(), -half.y());
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
    bend.bottomRightCorner<2, 2>() = bond.curvature * m * m.transpose();
    column.at(k) += bond.shear * own * own.transpose() + bend;
    if (column.has(j)) column.at(j) += bond.shear * other * own.transpose() - bend;
  }
}

/// Dilatations of k and of its neighbours p: theta_p = sum D m (theta_j - theta_p).
void add_dilatations(const FamilyOperator& plate, const PointBonds& bonds, std::uint32_t k, ColumnBlocks& column) {
  const auto add = [&](std::uint32_t p, const Eigen::Vector2d& by_k) {
    const Eigen::Vector2d factor = plate.dilatation_stiffness()[p] * by_k;
    Eigen::Vector2d sum(0, 0);
    for (const auto& bond : bonds.of(p)) {
      const Eigen::Vector2d by_j = bond.D_kj * direction(bond);
      sum -= by_j;
      const auto j = bond.neighbour(p);
      if (column.has(j)) column.at(j).bottomRightCorner<2, 2>() += by_j * factor.transpose();
    }
    if (column.has(p)) column.at(p).bottomRightCorner<2, 2>() += sum * factor.transpose();
  };
  Eigen::Vector2d own(0, 0);
  for (const auto& bond : bonds.of(k)) {
    own -= bond.D_kj * direction(bond);
    add(bond.neighbour(k), -bond.D_jk * direction(bond));
  }
  add(k, own);
}

}  // namespace

PointMatrix stiffness_matrix(const FamilyOperator& plate, bool with_dilatation, const std::vector<char>& wanted) {
  const PointBonds bonds(plate);
  const auto is_wanted = [&](std::uint32_t k) { return wanted.empty() || wanted[k]; };
  auto result = zeros(plate.points(), [&](Column& column, std::uint32_t k) {
    if (!is_wanted(k)) return;
    for (const auto& bond : bonds.of(k)) {
      const auto p = bond.neighbour(k);
      column.couple(p);
      if (!with_dilatation) continue;
      for (const auto& next : bonds.of(p)) column.couple(next.neighbour(p));
    }
  });
#pragma omp parallel
  {
    ColumnBlocks column(result);
#pragma omp for schedule(dynamic, 64)
    for (std::uint32_t k = 0; k < plate.points(); ++k) {
      if (!is_wanted(k)) continue;
      column.begin(k);
      add_bonds(bonds, k, column);
      if (with_dilatation) add_dilatations(plate, bonds, k, column);
    }
  }
  return with(std::move(result), plate.elastic_supports());
}

}  // namespace plate
