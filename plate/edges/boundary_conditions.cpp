#include "plate/edges/boundary_conditions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "plate/model/errors.hpp"
#include "plate/model/supports.hpp"

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

ConstrainedSolution constrained_solution(const SparseStiffness& K, const Eigen::VectorXd& f,
                                         const std::vector<PrescribedUnknown>& held) {
  ConstrainedSolution result{Eigen::VectorXd::Zero(K.cols()), Eigen::VectorXd(Eigen::Index(held.size()))};
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

namespace {

constexpr double left_over = 1e-9;  // of the right side and the solution; a regular matrix leaves 1e-15
constexpr int improvements = 3;     // with multipliers pivots may grow: 1e-6 is left then, after one improvement 1e-15

}  // namespace

ScaledFactor::ScaledFactor(const SparseStiffness& A)
    : rows_(Eigen::VectorXd::Zero(A.rows())), columns_(Eigen::VectorXd::Zero(A.cols())) {
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseStiffness::InnerIterator e(A, j); e; ++e) rows_[e.row()] = std::max(rows_[e.row()], std::abs(e.value()));
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseStiffness::InnerIterator e(A, j); e; ++e)
      columns_[j] = std::max(columns_[j], std::abs(e.value()) / rows_[e.row()]);
  if (A.rows() == 0) return;
  if (!(rows_.minCoeff() > 0 && columns_.minCoeff() > 0))
    throw NumericalError("a body with an unknown without stiffness, or a condition on nothing");
  factor_.emplace(rows_.cwiseInverse().asDiagonal() * A * columns_.cwiseInverse().asDiagonal());
}

Eigen::VectorXd ScaledFactor::solve(const Eigen::VectorXd& b) const {
  if (b.size() == 0) return b;
  const Eigen::VectorXd right = b.cwiseQuotient(rows_);
  Eigen::VectorXd x = factor_->solve(right), left = right - factor_->matrix() * x;
  const auto solves = [&] { return left.norm() <= left_over * std::max(right.norm(), x.norm()); };
  for (int i = 0; i < improvements && !solves(); ++i) {
    x += factor_->solve(left);
    left = right - factor_->matrix() * x;
  }
  if (!solves())
    throw NumericalError(
        fmt::format("the factors leave {:.1e} of the loads: a body that is loose, conditions that "
                    "contradict, or more points than they can carry",
                    left.norm() / std::max(right.norm(), x.norm())));
  return x.cwiseQuotient(columns_);
}

std::size_t ScaledFactor::bytes() const {
  constexpr std::size_t entry = sizeof(double) + sizeof(GeneralFactor::Matrix::StorageIndex);
  return factor_ ? factor_->bytes() + std::size_t(factor_->matrix().nonZeros()) * entry : 0;
}

namespace {

std::array<bool, unknowns_per_point> held_on_edge(SupportKind kind, std::size_t number) {
  if (is_layer(kind) || kind == SupportKind::pinned)
    throw Refused({{Subject::support, number, "surface nodes hold edges, not layers and not single points"}});
  const auto held = held_by(kind);
  return {held.w, held.normal, held.tangential};
}

}  // namespace

EdgeCondition edge_condition(SupportKind kind, const EdgeAction& a, std::size_t number) {
  EdgeCondition result{held_on_edge(kind, number), {}};
  const std::optional<double> forces[] = {a.shear, a.moment, a.twisting_moment},
                              values[] = {a.deflection, a.normal_rotation, a.tangential_rotation};
  const char* const names[][2] = {
      {"shear", "deflection"}, {"moment", "normal rotation"}, {"twisting moment", "tangential rotation"}};
  for (std::size_t i = 0; i < unknowns_per_point; ++i) {
    const auto& [force, value] = names[i];
    if (result.held[i] && forces[i])
      throw Refused({{Subject::load_edges, number,
                      fmt::format("a {} acts on an edge whose {} is held: it would do nothing", force, value)}});
    if (!result.held[i] && values[i])
      throw Refused(
          {{Subject::support, number, fmt::format("a {} is given for an edge that does not hold it", value)}});
    result.value[i] = (result.held[i] ? values[i] : forces[i]).value_or(0);
  }
  return result;
}

int normal_rotation(int axis) {
  return axis == 0 ? 2 : 1;
}

int tangential_rotation(int axis) {
  return axis == 0 ? 1 : 2;
}

PointValues rotated(const PointValues& v, const geometry::Point& n) {
  const geometry::Point psi = v[1] * n + v[2] * geometry::Point(-n.y(), n.x());
  return {v[0], psi.y(), -psi.x()};
}

PointValues conjugate(const PointValues& f, const geometry::Point& n) {
  const geometry::Point moment = f[1] * n + f[2] * geometry::Point(-n.y(), n.x());
  return {f[0], -moment.y(), moment.x()};
}

}  // namespace plate
