#include "plate/boundary/conditions.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include "plate/model/numerical_error.hpp"

namespace plate {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr double left_over = 1e-9;  // of the right side and the solution; a regular matrix leaves 1e-15

/// A^-1 b, rows and columns scaled to their largest entries first: those of values and of forces have other units.
Eigen::VectorXd solved(const SparseStiffness& A, const Eigen::VectorXd& b) {
  if (A.rows() == 0) return b;
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(A.rows()), columns = Eigen::VectorXd::Zero(A.cols());
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseStiffness::InnerIterator e(A, j); e; ++e) rows[e.row()] = std::max(rows[e.row()], std::abs(e.value()));
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseStiffness::InnerIterator e(A, j); e; ++e)
      columns[j] = std::max(columns[j], std::abs(e.value()) / rows[e.row()]);
  if (!(rows.minCoeff() > 0 && columns.minCoeff() > 0))
    throw NumericalError("a body with an unknown without stiffness, or a condition on nothing");
  const SparseStiffness scaled = rows.cwiseInverse().asDiagonal() * A * columns.cwiseInverse().asDiagonal();
  Eigen::SparseLU<SparseStiffness> factor;
  factor.compute(scaled);
  const Eigen::VectorXd right = b.cwiseQuotient(rows);
  if (factor.info() != Eigen::Success) throw NumericalError("a body that is loose, or conditions that contradict");
  Eigen::VectorXd x = factor.solve(right);
  x += factor.solve(Eigen::VectorXd(right - scaled * x));
  if (!((scaled * x - right).norm() <= left_over * std::max(right.norm(), x.norm())))
    throw NumericalError("a body that is loose, or conditions that contradict");
  return x.cwiseQuotient(columns);
}

void add(const SparseStiffness& block, Eigen::Index row, Eigen::Index column, bool transposed, Triplets& to) {
  for (Eigen::Index j = 0; j < block.outerSize(); ++j)
    for (SparseStiffness::InnerIterator e(block, j); e; ++e)
      to.emplace_back(row + (transposed ? e.col() : e.row()), column + (transposed ? e.row() : e.col()), e.value());
}

}  // namespace

SparseStiffness with_multipliers(const SparseStiffness& K, const SparseStiffness& B) {
  Triplets entries;
  add(K, 0, 0, false, entries);
  add(B, K.rows(), 0, false, entries);
  add(B, 0, K.cols(), true, entries);
  SparseStiffness result(K.rows() + B.rows(), K.cols() + B.rows());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

MultipliedSolution solution_with_multipliers(const SparseStiffness& K, const SparseStiffness& B,
                                             const Eigen::VectorXd& f, const Eigen::VectorXd& c) {
  Eigen::VectorXd right(f.size() + c.size());
  right << f, c;
  const Eigen::VectorXd both = solved(with_multipliers(K, B), right);
  return {both.head(f.size()), both.tail(c.size()), B.transpose() * both.tail(c.size())};
}

HeldSolution solution_held(const SparseStiffness& K, const Eigen::VectorXd& f, const std::vector<HeldUnknown>& held) {
  HeldSolution result{Eigen::VectorXd::Zero(K.cols()), Eigen::VectorXd(Eigen::Index(held.size()))};
  std::vector<char> is_held(std::size_t(K.cols()), false);
  for (const auto& [unknown, value] : held) result.values[unknown] = value, is_held[std::size_t(unknown)] = true;
  std::vector<Eigen::Index> place(std::size_t(K.cols())), free;
  for (Eigen::Index i = 0; i < K.cols(); ++i)
    if (!is_held[std::size_t(i)]) place[std::size_t(i)] = Eigen::Index(free.size()), free.push_back(i);
  Triplets entries;
  for (const Eigen::Index j : free)
    for (SparseStiffness::InnerIterator e(K, j); e; ++e)
      if (!is_held[std::size_t(e.row())])
        entries.emplace_back(place[std::size_t(e.row())], place[std::size_t(j)], e.value());
  SparseStiffness inside(Eigen::Index(free.size()), Eigen::Index(free.size()));
  inside.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd right = f - K * result.values;
  result.values(free) = solved(inside, right(free));
  const Eigen::VectorXd forces = K * result.values - f;
  for (std::size_t i = 0; i < held.size(); ++i) result.reactions[Eigen::Index(i)] = forces[held[i].unknown];
  return result;
}

}  // namespace plate
