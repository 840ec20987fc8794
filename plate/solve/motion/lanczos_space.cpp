#include "plate/solve/motion/lanczos_space.hpp"

#include <algorithm>

#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/statics.hpp"

namespace plate {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// `vectors`^T x, the same to the last bit with any number of threads.
template <typename Vectors>
VectorXd products(const Vectors& vectors, const VectorXd& x) {
  constexpr Index together = 8;
  VectorXd result(vectors.cols());
#pragma omp parallel for schedule(static)
  for (Index first = 0; first < vectors.cols(); first += together) {
    const Index count = std::min(together, vectors.cols() - first);
    result.segment(first, count).noalias() = vectors.middleCols(first, count).transpose() * x;
  }
  return result;
}

/// Takes `vectors` times `shares` out of u, the same to the last bit with any number of threads.
template <typename Vectors>
void take_out(const Vectors& vectors, const VectorXd& shares, VectorXd& u) {
  constexpr Index together = 2048;
#pragma omp parallel for schedule(static)
  for (Index first = 0; first < u.size(); first += together) {
    const Index count = std::min(together, u.size() - first);
    u.segment(first, count).noalias() -= vectors.middleRows(first, count) * shares;
  }
}

}  // namespace

LanczosSpace::LanczosSpace(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
                           const Preconditioner& inverse)
    : plate_(plate),
      constraints_(constraints),
      inertia_(inertia),
      inverse_(inverse),
      points_(Index(plate.points())),
      vectors_(unknowns_per_point * points_, 0),
      forces_(unknowns_per_point * points_, 0) {}

bool LanczosSpace::add(const Forces& load) {
  const StaticOptions options{1e-8, 10000, {}};
  const auto solution = conjugate_gradients(plate_, constraints_, load, options, &inverse_);
  if (!solution.converged) throw NumericalError("Lanczos vectors: conjugate gradients: " + solution.stop_reason);
  return add_state(solution.state);
}

bool LanczosSpace::add_after(Index i) {
  State answer;
  inverse_.apply(inertia_(state_of(vectors_.col(i))), answer);
  constraints_.impose(answer);
  return add_state(answer, std::max<Index>(0, 2 * i - size_));
}

VectorXd LanczosSpace::coordinates(const State& state) const {
  return vectors().transpose() * flat(inertia_(state));
}

const MatrixXd& LanczosSpace::stiffness() {
  const Index known = stiffness_.rows(), fresh = size_ - known;
  if (fresh == 0) return stiffness_;
  const MatrixXd columns = vectors().transpose() * forces_.middleCols(known, fresh);
  stiffness_.conservativeResize(size_, size_);
  stiffness_.rightCols(fresh) = columns;
  stiffness_.bottomLeftCorner(fresh, known) = columns.topRows(known).transpose();
  auto corner = stiffness_.bottomRightCorner(fresh, fresh);
  corner = ((corner + corner.transpose()) / 2).eval();
  return stiffness_;
}

bool LanczosSpace::add_state(const State& answer, Index coupled) {
  VectorXd u = flat(answer);
  const double whole = norm(u);
  if (!(whole > 0)) return false;
  // what is left of a vector may be a hundred millionth of it: rounding of what was taken out is taken out again, and
  // degrees of freedom that follow others, whose rounding no product sees, are set anew
  double rest = whole;
  for (int pass = 0; pass < 4; ++pass) {
    const double before = rest;
    const Index first = pass == 0 ? coupled : 0;
    const auto basis = vectors_.middleCols(first, size_ - first);
    take_out(basis, products(basis, flat(inertia_(state_of(u)))), u);
    State left = state_of(u);
    constraints_.impose(left);
    u = flat(left), rest = norm(u);
    if (!(rest > 1e-10 * whole)) return false;
    if (pass > 0 && rest > 0.5 * before) break;
  }
  u /= rest;
  if (size_ == vectors_.cols()) {
    constexpr Index more = 16;
    vectors_.conservativeResize(u.size(), size_ + more);
    forces_.conservativeResize(u.size(), size_ + more);
  }
  Forces force;
  plate_.internal_force(state_of(u), force);
  constraints_.fold(force);
  vectors_.col(size_) = u;
  forces_.col(size_) = -flat(force);
  ++size_;
  return true;
}

double LanczosSpace::norm(const VectorXd& u) const {
  return std::sqrt(u.dot(flat(inertia_(state_of(u)))));
}

State LanczosSpace::state_of(const VectorXd& u) const {
  return Eigen::Map<const State>(u.data(), unknowns_per_point, points_);
}

}  // namespace plate
