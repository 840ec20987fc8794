#include "cases/papers/bodies/equilibrium.hpp"

#include <algorithm>

namespace boundary_bodies {
namespace {

using plate::LatticeBody;
using plate::PrescribedUnknown;
using plate::ScaledFactor;
using plate::SparseStiffness;

using Entries = std::vector<Eigen::Triplet<double>>;
void add_block(const SparseStiffness& block, Eigen::Index row, Eigen::Index column, bool transposed, Entries& to) {
  for (Eigen::Index j = 0; j < block.outerSize(); ++j)
    for (SparseStiffness::InnerIterator e(block, j); e; ++e)
      to.emplace_back(row + (transposed ? e.col() : e.row()), column + (transposed ? e.row() : e.col()), e.value());
}

}  // namespace

LatticeBody box_body(const std::vector<int>& counts, int reach) {
  LatticeBody::Index last(0, 0, 0);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, counts.size()); ++i) last[Eigen::Index(i)] = counts[i] - 1;
  std::vector<LatticeBody::Index> places;
  for (int z = 0; z <= last[2]; ++z)
    for (int y = 0; y <= last[1]; ++y)
      for (int x = 0; x <= last[0]; ++x) places.push_back({x, y, z});
  return plate::lattice_body(int(counts.size()), std::move(places), reach,
                             [](const LatticeBody::Index&, int, int) { return 0.5; });
}

SparseStiffness with_multipliers(const SparseStiffness& K, const SparseStiffness& B) {
  Entries entries;
  add_block(K, 0, 0, false, entries);
  add_block(B, K.rows(), 0, false, entries);
  add_block(B, 0, K.cols(), true, entries);
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

ConstrainedSolution constrained_solution(const SparseStiffness& K, const Eigen::VectorXd& f,
                                         const std::vector<PrescribedUnknown>& held) {
  ConstrainedSolution result{Eigen::VectorXd::Zero(K.cols()), Eigen::VectorXd(Eigen::Index(held.size()))};
  std::vector<char> is_held(std::size_t(K.cols()), false);
  for (const auto& [unknown, value] : held) result.values[unknown] = value, is_held[std::size_t(unknown)] = true;
  std::vector<Eigen::Index> place(std::size_t(K.cols())), free;
  for (Eigen::Index i = 0; i < K.cols(); ++i)
    if (!is_held[std::size_t(i)]) place[std::size_t(i)] = Eigen::Index(free.size()), free.push_back(i);
  Entries entries;
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

}  // namespace boundary_bodies
