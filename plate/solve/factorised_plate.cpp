#include "plate/solve/factorised_plate.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "plate/model/errors.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {

std::unique_ptr<Factor> factorised(const Eigen::SparseMatrix<double>& matrix) {
  // a part that hangs on two points of the short-horizon plate, but on more of the true one, leaves a zero
  for (double shift = 0;; shift = shift == 0 ? 1e-12 : 1e3 * shift) try {
      return std::make_unique<Factor>(matrix, shift);
    } catch (const NumericalError&) {
      if (shift > 1e-4) throw;
    }
}

Eigen::VectorXd gathered(const Unknowns& unknowns, const Forces& forces) {
  Eigen::VectorXd result(unknowns.size());
  for (Eigen::Index u = 0; u < result.size(); ++u) result[u] = at_dof(forces, unknowns.dof[std::size_t(u)]);
  return result;
}

std::vector<State> solutions(const Factor& factor, const Unknowns& unknowns, const Constraints& constraints,
                             const std::vector<Forces>& loads) {
  Eigen::MatrixXd right(unknowns.size(), Eigen::Index(loads.size()));
  for (std::size_t i = 0; i < loads.size(); ++i) {
    Forces folded = loads[i];
    constraints.fold(folded);
    right.col(Eigen::Index(i)) = gathered(unknowns, folded);
  }
  const Eigen::MatrixXd solution = factor.solve(right);
  std::vector<State> result(loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    result[i].setZero(loads[i].rows(), loads[i].cols());
    for (Eigen::Index u = 0; u < solution.rows(); ++u)
      at_dof(result[i], unknowns.dof[std::size_t(u)]) = solution(u, Eigen::Index(i));
    constraints.impose(result[i]);
  }
  return result;
}

Forces folded_diagonal(const Operator& plate, const Constraints& constraints) {
  Forces diagonal = plate.diagonal();
  constraints.fold_diagonal(diagonal);
  return diagonal;
}

AssembledPlate::AssembledPlate(const Operator& plate, const Constraints& constraints, const PointMatrix& stiffness,
                               const Boundary* shared)
    : constraints_(constraints) {
  PointMatrix matrix = folded(stiffness, constraints);
  const Forces diagonal = folded_diagonal(plate, constraints);
  if (shared) {
    unknowns_ = owned_unknowns(*shared, matrix.points());
    factor_ = distributed_factor(std::move(matrix), *shared, constraints, diagonal);
    return;
  }
  unknowns_ = unknowns(diagonal, elimination_order(matrix, diagonal));
  factor_ = std::make_unique<Factor>(of_unknowns(matrix, unknowns_));
}

void AssembledPlate::apply(const Forces& residual, State& result) const {
  const Eigen::MatrixXd solution = factor_->solve(gathered(unknowns_, residual));
  result.setZero(residual.rows(), residual.cols());
  for (Eigen::Index u = 0; u < solution.rows(); ++u) at_dof(result, unknowns_.dof[std::size_t(u)]) = solution(u, 0);
}

std::vector<State> AssembledPlate::solve(const std::vector<Forces>& loads) const {
  return solutions(*factor_, unknowns_, constraints_, loads);
}

namespace {

/// Global numbers of the points, rank by rank; -1 where their owner is not asked. `halo`: fetches those of ghosts.
template <typename Halo>
std::vector<std::int64_t> numbers(const PointMap& map, std::size_t points, const std::vector<std::uint32_t>& own,
                                  const Halo& halo) {
  const auto counts = gathered(map, std::vector<std::int64_t>{std::int64_t(own.size())});
  auto next = std::accumulate(counts.begin(), counts.begin() + map.rank(), std::int64_t(0));
  std::vector<std::int64_t> result(points, -1);
  for (const auto k : own) result[k] = next++;
  halo.fetch(result);
  return result;
}

/// A block of the row of an own point.
struct Block {
  std::int64_t column;
  Eigen::Matrix3d entries;
};

/// Owned points of a plate, and, in a matrix of a plate and its plane, of those behind them.
std::vector<std::uint32_t> owned_points(const Boundary& boundary, std::size_t points) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < points; ++k)
    if (boundary.owns(k % boundary.cloud.size())) result.push_back(k);
  return result;
}

/// Rows of P^T K P of owned points, without what is held. `free`: degrees of freedom with stiffness are above 0.
DistributedRows rows(const PointMatrix& matrix, const Boundary& boundary, const std::vector<std::uint32_t>& own,
                     const std::vector<std::int64_t>& number, const State& free) {
  std::vector<std::vector<Block>> found(matrix.points());
  const auto points = std::uint32_t(boundary.cloud.size());
  const auto add = [&](std::uint32_t row, std::uint32_t column, Eigen::Matrix3d entries) {
    if (!boundary.owns(row % points)) return;
    for (Eigen::Index i = 0; i < unknowns_per_point; ++i)
      for (Eigen::Index j = 0; j < unknowns_per_point; ++j)
        if (!(free(i, row) > 0) || !(free(j, column) > 0)) entries(i, j) = 0;
    if (row != column && entries.isZero(0)) return;
    if (number[column] < 0) throw std::logic_error("a point is coupled to one whose owner nobody asks");
    found[row].push_back({number[column], entries});
  };
  for (std::uint32_t k = 0; k < matrix.points(); ++k)
    for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b) {
      const auto j = matrix.row[b];
      if (j != k) {
        add(j, k, matrix.block[b]), add(k, j, matrix.block[b].transpose());
        continue;
      }
      add(k, k, matrix.block[b]);
    }
  DistributedRows result;
  for (const auto k : own) {
    std::ranges::sort(found[k], {}, &Block::column);
    for (const auto& [column, entries] : found[k]) {
      result.column.push_back(column);
      for (Eigen::Index i = 0; i < unknowns_per_point; ++i)
        for (Eigen::Index j = 0; j < unknowns_per_point; ++j) result.block.push_back(entries(i, j));
    }
    result.first.push_back(result.column.size());
    const auto& x = boundary.cloud.positions[k % points];
    result.position.insert(result.position.end(), {x.x(), x.y()});
    found[k] = {};
  }
  return result;
}

}  // namespace

Unknowns owned_unknowns(const Boundary& boundary, std::size_t points) {
  Unknowns result;
  for (const auto k : owned_points(boundary, points))
    for (const auto& dof : dofs_of(k)) result.dof.push_back(dof);
  return result;
}

std::unique_ptr<Factor> distributed_factor_of_any_sign(PointMatrix folded, const Boundary& boundary,
                                                       const Constraints& constraints, State free, double shift) {
  const auto own = owned_points(boundary, folded.points());
  const auto number = numbers(boundary.map, folded.points(), own, constraints);
  constraints.fetch(free);
  for (std::size_t k = 0; k < folded.points(); ++k) folded.block[folded.first[k]].diagonal() *= 1 + shift;
  return std::make_unique<Factor>(boundary.map.communicator->inverse(rows(folded, boundary, own, number, free)));
}

std::unique_ptr<Factor> distributed_factor(PointMatrix folded, const Boundary& boundary, const Constraints& constraints,
                                           State free, double shift) {
  auto result = distributed_factor_of_any_sign(std::move(folded), boundary, constraints, std::move(free), shift);
  if (result->negative() > 0) throw NotPositive("factorisation: the stiffness is not positive");
  return result;
}

DistributedFactor::DistributedFactor(const Operator& plate, const Boundary& boundary, const PointMatrix& stiffness,
                                     const HaloExchange* seen)
    : boundary_(boundary), own_(owned_points(boundary, boundary.cloud.size())) {
  const auto points = boundary.cloud.size();
  const auto number =
      seen ? numbers(boundary.map, points, own_, *seen) : numbers(boundary.map, points, own_, boundary.constraints);
  State free = folded_diagonal(plate, boundary.constraints);
  if (seen)
    seen->fetch(std::span(free.data(), std::size_t(free.size())));
  else
    boundary.constraints.fetch(free);
  const auto matrix = folded(stiffness, boundary.constraints);
  inverse_ = boundary.map.communicator->inverse(rows(matrix, boundary, own_, number, free));
}

DistributedFactor::~DistributedFactor() = default;

void DistributedFactor::apply(const Forces& residual, State& result) const {
  std::vector<double> values;
  values.reserve(unknowns_per_point * own_.size());
  for (const auto k : own_)
    for (Eigen::Index c = 0; c < unknowns_per_point; ++c) values.push_back(residual(c, k));
  inverse_->apply(values);
  result.setZero(residual.rows(), residual.cols());
  for (std::size_t n = 0; n < own_.size(); ++n)
    for (Eigen::Index c = 0; c < unknowns_per_point; ++c) result(c, own_[n]) = values[index_by_points(n, c)];
}

}  // namespace plate
