#include "plate/bonds/levels/coarse_plate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "plate/bonds/levels/coarse_columns.hpp"
#include "plate/model/ranks/gathered.hpp"
#include "plate/solve/assembled_plate.hpp"
#include "plate/solve/matrices/factor.hpp"

namespace plate {
namespace {

/// A matrix of zeros that couples every coarse point to those in the window about it.
PointMatrix zeros(const std::vector<Transfer::Cell>& cells, const CoarseCells& index) {
  PointMatrix result;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto begin = std::ptrdiff_t(result.row.size());
    for (int y = -coarse_window / 2; y <= coarse_window / 2; ++y)
      for (int x = -coarse_window / 2; x <= coarse_window / 2; ++x)
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

/// The lower triangle of R L R^T.
PointMatrix coarse_stiffness(const Operator& L, const Transfer& transfer, const Constraints& constraints) {
  const CoarseCells index(transfer.cells());
  PointMatrix result = zeros(transfer.cells(), index);
  for_each_coarse_column(L, transfer, constraints, index,
                         [&](std::uint32_t i, std::uint32_t j, int component, const Eigen::Vector3d& K_ij) {
                           if (j < i) return;  // what j has of i, i has of j
                           const auto begin = result.row.begin() + std::ptrdiff_t(result.first[i]),
                                      end = result.row.begin() + std::ptrdiff_t(result.first[i + 1]);
                           const auto at = std::lower_bound(begin, end, j) - result.row.begin();
                           result.block[std::size_t(at)].row(component) = K_ij.transpose();
                         });
  return without_rounding(result);
}

class FactorisedCoarsePlate : public CoarsePlate {
public:
  explicit FactorisedCoarsePlate(const PointMatrix& matrix) {
    const Forces diagonal = diagonal_of(matrix);
    unknowns_ = unknowns(diagonal, elimination_order(matrix, diagonal));
    factor_ = factorised(of_unknowns(matrix, unknowns_));
  }

  void solve(const Forces& force, State& u) const override {
    const Eigen::MatrixXd solution = factor_->solve(plate::gathered(unknowns_, force));
    u.setZero(3, force.cols());
    for (Eigen::Index i = 0; i < solution.rows(); ++i) at_dof(u, unknowns_.dof[std::size_t(i)]) = solution(i, 0);
  }
  std::size_t bytes() const override { return factor_->bytes(); }

private:
  Unknowns unknowns_;
  std::unique_ptr<Factor> factor_;
};

class SharedCoarsePlate : public CoarsePlate {
public:
  SharedCoarsePlate(const Ranks& all, const Operator& L, const Transfer& transfer, const Boundary& boundary)
      : constraints_(boundary.constraints),
        points_(Eigen::Index(boundary.cloud.size())),
        fine_(transfer.fine_points()) {
    for (std::uint32_t i = 0; i < fine_.size(); ++i)
      if (boundary.owns(fine_[i])) own_.push_back(i);
    inverse_ = all.inverse(rows(L, transfer, boundary, numbers(all)));
  }

  void solve(const Forces& force, State& u) const override {
    std::vector<double> values;
    values.reserve(3 * own_.size());
    for (const auto i : own_)
      for (Eigen::Index c = 0; c < 3; ++c) values.push_back(force(c, Eigen::Index(i)));
    inverse_->apply(values);
    u.setZero(3, force.cols());
    for (std::size_t n = 0; n < own_.size(); ++n)
      for (Eigen::Index c = 0; c < 3; ++c) u(c, Eigen::Index(own_[n])) = values[3 * n + std::size_t(c)];
    fetch(u);
  }
  std::size_t bytes() const override { return 0; }  // the libraries behind it do not say

private:
  /// The values of copies, by way of the points that the coarse ones are.
  void fetch(State& coarse) const {
    State fine = State::Zero(3, points_);
    for (std::size_t i = 0; i < fine_.size(); ++i) fine.col(fine_[i]) = coarse.col(Eigen::Index(i));
    constraints_.fetch(fine);
    for (std::size_t i = 0; i < fine_.size(); ++i) coarse.col(Eigen::Index(i)) = fine.col(fine_[i]);
  }

  /// Of all coarse points seen here, -1 where their owner is not asked.
  std::vector<std::int64_t> numbers(const Ranks& all) const {
    const auto counts = gathered(all, std::vector<std::int64_t>{std::int64_t(own_.size())});
    const auto before = std::accumulate(counts.begin(), counts.begin() + all.rank(), std::int64_t(0));
    State number = State::Constant(3, Eigen::Index(fine_.size()), -1);
    for (std::size_t n = 0; n < own_.size(); ++n) number(0, Eigen::Index(own_[n])) = double(before + std::int64_t(n));
    fetch(number);
    std::vector<std::int64_t> result;
    for (Eigen::Index i = 0; i < number.cols(); ++i) result.push_back(std::int64_t(number(0, i)));
    return result;
  }

  SharedRows rows(const Operator& L, const Transfer& transfer, const Boundary& boundary,
                  const std::vector<std::int64_t>& number) const {
    constexpr std::size_t most = coarse_window * coarse_window;
    constexpr double rounding = 1e-12;
    struct Block {
      std::int64_t column = -1;
      std::array<double, 9> entries{};
      double largest() const {
        return std::abs(*std::ranges::max_element(entries, {}, [](double value) { return std::abs(value); }));
      }
    };
    std::vector<std::array<Block, most>> found(own_.size());
    std::vector<std::int32_t> place(fine_.size(), -1);
    for (std::size_t n = 0; n < own_.size(); ++n) place[own_[n]] = std::int32_t(n);
    const auto& cells = transfer.cells();
    for_each_coarse_column(L, transfer, constraints_, CoarseCells(cells),
                           [&](std::uint32_t i, std::uint32_t j, int component, const Eigen::Vector3d& K_ij) {
                             if (place[i] < 0) return;
                             const auto x = cells[j].column - cells[i].column, y = cells[j].row - cells[i].row;
                             const auto half = coarse_window / 2;
                             auto& block =
                                 found[std::size_t(place[i])][std::size_t((y + half) * coarse_window + x + half)];
                             block.column = number[j];
                             for (int c = 0; c < 3; ++c) block.entries[std::size_t(3 * c + component)] = K_ij[c];
                           });
    SharedRows result;
    for (std::size_t n = 0; n < own_.size(); ++n) {
      auto& blocks = found[n];
      std::ranges::sort(blocks, {}, &Block::column);
      double largest = 0;
      for (const auto& block : blocks) largest = std::max(largest, block.largest());
      for (const auto& block : blocks) {
        if (block.largest() <= rounding * largest) continue;
        if (block.column < 0) throw std::logic_error("a coarse point is coupled to one whose owner nobody asks");
        result.column.push_back(block.column);
        result.block.insert(result.block.end(), block.entries.begin(), block.entries.end());
      }
      result.first.push_back(result.column.size());
      const auto& x = boundary.cloud.positions[fine_[own_[n]]];
      result.position.insert(result.position.end(), {x.x(), x.y()});
    }
    return result;
  }

  const Constraints& constraints_;
  Eigen::Index points_;
  std::vector<std::uint32_t> fine_;  // the point of the plate that each coarse one is
  std::vector<std::uint32_t> own_;   // coarse points of this process
  std::unique_ptr<SharedInverse> inverse_;
};

}  // namespace

std::unique_ptr<CoarsePlate> coarse_plate(const Operator& L, const Transfer& transfer, const Boundary& boundary) {
  if (const Ranks* all = ranks()) return std::make_unique<SharedCoarsePlate>(*all, L, transfer, boundary);
  return std::make_unique<FactorisedCoarsePlate>(coarse_stiffness(L, transfer, boundary.constraints));
}

}  // namespace plate
