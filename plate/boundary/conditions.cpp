#include "plate/boundary/conditions.hpp"

#include "plate/boundary/scaled_factor.hpp"

namespace plate {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
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
  const Eigen::VectorXd both = ScaledFactor(with_multipliers(K, B)).solve(right);
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
  result.values(free) = ScaledFactor(inside).solve(right(free));
  const Eigen::VectorXd forces = K * result.values - f;
  for (std::size_t i = 0; i < held.size(); ++i) result.reactions[Eigen::Index(i)] = forces[held[i].unknown];
  return result;
}

}  // namespace plate
