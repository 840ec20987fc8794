#include "plate/edges/boundary_conditions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "plate/model/errors.hpp"
#include "plate/model/supports.hpp"

namespace plate {

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
