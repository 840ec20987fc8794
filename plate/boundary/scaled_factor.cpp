#include "plate/boundary/scaled_factor.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "plate/model/numerical_error.hpp"

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

}  // namespace plate
