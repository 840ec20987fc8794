#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/buckling.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/statics.hpp"

namespace plate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double inner_tolerance = 1e-3;  // of a solution, relative to that of the eigenpairs
constexpr std::size_t most_iterations = 200000;

/// A and B of a distributed plate, on the free degrees of freedom; all others of a vector are zero. Collective.
class FreePencil {
public:
  FreePencil(const SharedPencil& given, double tolerance)
      : given_(given),
        options_{tolerance, most_iterations, {}},
        weight_(
            folded_diagonal(given.stiffness, constraints()).unaryExpr([](double d) { return d > 0 ? 1 / d : 0.0; })) {}

  const Constraints& constraints() const { return given_.constraints; }
  State free(const State& state) const { return (weight_.array() > 0).select(state, 0.0); }
  State imposed(State vector) const {
    constraints().impose(vector);
    return vector;
  }
  Forces stiffness_times(const State& vector) const {
    Forces force;
    given_.stiffness.internal_force(imposed(vector), force);
    constraints().fold(force);
    return free(-force);
  }
  Forces other_times(const State& vector) const {
    Forces force = given_.share * product(given_.other, imposed(vector));
    constraints().fold(force);
    return free(force);
  }
  State solved(const Forces& load) const {
    stop_if_asked(given_.purpose, constraints());
    auto found = conjugate_gradients(given_.stiffness, constraints(), load, options_, given_.inverse);
    if (!found.converged)
      throw NumericalError(std::string(given_.purpose) + ": conjugate gradients " + found.stop_reason);
    return free(found.state);
  }
  /// Smooth and of all modes.
  State start() const { return solved(free(given_.start)); }
  /// Another one.
  State second_start() const { return solved(free(given_.start.cwiseAbs2())); }
  double dot(const State& a, const State& b) const {
    return ordered_sum<1>(constraints(), std::size_t(a.size()),
                          [&](std::size_t i) { return std::array<double, 1>{a.data()[i] * b.data()[i]}; })[0];
  }
  double norm(const Forces& force) const { return std::sqrt(dot(force.cwiseProduct(weight_), force)); }
  /// Largest |mu| of single points.
  double largest_of_points() const {
    const auto& matrix = given_.other;
    Forces diagonal = zero_forces(matrix.points());
    for (std::size_t k = 0; k < matrix.points(); ++k) diagonal.col(Index(k)) = matrix.block[matrix.first[k]].diagonal();
    constraints().fold_diagonal(diagonal);
    return largest_of(constraints(), diagonal.cwiseAbs().cwiseProduct(weight_).maxCoeff());
  }

private:
  const SharedPencil& given_;
  StaticOptions options_;
  Forces weight_;
};

/// Lanczos vectors of A^-1 B, orthonormal by A, with restarts that keep the best of them.
class LanczosOfPencil {
public:
  /// `known`: vectors of length 1 by A, which are taken out.
  LanczosOfPencil(const FreePencil& pencil, Index count, Index basis, const std::vector<State>& known = {})
      : pencil_(pencil), count_(count), basis_(basis), out_(known) {
    for (const auto& one : known) images_out_.push_back(pencil.stiffness_times(one));
  }

  /// Goes on until the largest pairs are known; false where they are not in so many restarts.
  bool find(State next, double tolerance, std::size_t most_restarts) {
    for (std::size_t restart = 0; restart <= most_restarts; ++restart) {
      double left = orthogonal(next);
      while (left > 0 && Index(vectors_.size()) < basis_) {
        add(next / left);
        next = pencil_.solved(by_other_), left = orthogonal(next);
      }
      ritz_ = eigenpairs(projected_.topLeftCorner(Index(vectors_.size()), Index(vectors_.size())));
      if (!(left > 0) || known(left, tolerance)) return true;
      keep(count_ + (basis_ - count_) / 2);
    }
    return false;
  }

  Index found() const { return std::min(count_, Index(vectors_.size())); }
  /// The largest are 0, 1, ...
  double value(Index i) const { return ritz_.values[ritz_.values.size() - 1 - i]; }
  State vector(Index i) const { return combined(vectors_, ritz_.vectors.col(ritz_.values.size() - 1 - i)); }

private:
  static State combined(const std::vector<State>& vectors, const VectorXd& shares) {
    State result = shares[0] * vectors[0];
    for (std::size_t i = 1; i < vectors.size(); ++i) result += shares[Index(i)] * vectors[i];
    return result;
  }

  /// Takes what the vectors have of it out, twice; returns its length, zero where rounding is left.
  double orthogonal(State& next) {
    constexpr double rounding = 1e-12;
    const double before = std::sqrt(pencil_.dot(next, pencil_.stiffness_times(next)));
    const auto take_out = [&](const std::vector<State>& vectors, const std::vector<State>& images) {
      for (std::size_t i = 0; i < vectors.size(); ++i) next -= pencil_.dot(images[i], next) * vectors[i];
    };
    for (int twice = 0; twice < 2; ++twice) take_out(out_, images_out_), take_out(vectors_, images_);
    const double left = std::sqrt(pencil_.dot(next, pencil_.stiffness_times(next)));
    return left > rounding * before ? left : 0;
  }

  void add(State vector) {
    images_.push_back(pencil_.stiffness_times(vector));
    by_other_ = pencil_.other_times(vector);
    vectors_.push_back(std::move(vector));
    const auto size = Index(vectors_.size());
    projected_.conservativeResize(size, size);
    for (Index i = 0; i < size; ++i)
      projected_(i, size - 1) = projected_(size - 1, i) = pencil_.dot(vectors_[std::size_t(i)], by_other_);
  }

  /// True where the residuals of the wanted pairs are small; of pairs that are not positive beside the largest.
  bool known(double left, double tolerance) const {
    constexpr double small = 1e-3;
    const auto size = ritz_.values.size();
    const double largest = ritz_.values.cwiseAbs().maxCoeff();
    for (Index i = 0; i < found(); ++i)
      if (left * std::abs(ritz_.vectors(size - 1, size - 1 - i)) > tolerance * std::max(value(i), small * largest))
        return false;
    return size >= count_;
  }

  void keep(Index kept) {
    std::vector<State> vectors, images;
    VectorXd values(kept);
    for (Index i = 0; i < kept; ++i) {
      const VectorXd shares = ritz_.vectors.col(ritz_.values.size() - 1 - i);
      vectors.push_back(combined(vectors_, shares)), images.push_back(combined(images_, shares));
      values[i] = value(i);
    }
    vectors_ = std::move(vectors), images_ = std::move(images);
    projected_ = values.asDiagonal();
  }

  const FreePencil& pencil_;
  Index count_, basis_;
  std::vector<State> out_, images_out_, vectors_, images_;  // images: by A
  Forces by_other_;                                         // B times the last vector
  MatrixXd projected_;
  Eigenpairs ritz_{};
};

}  // namespace

namespace {

/// Adds to the pairs found those as large that a Krylov space, which holds one vector of each multiple value, left out.
void find_multiple(const FreePencil& pencil, double tolerance, std::vector<std::pair<double, State>>& found) {
  constexpr double rough = 1e-2;  // enough to see how large the largest of the rest is
  constexpr Index basis = 24;
  constexpr std::size_t most_restarts = 300;
  const auto count = found.size();
  for (;;) {
    std::vector<State> known;
    for (const auto& [value, vector] : found) known.push_back(vector);
    const auto largest = [&](double accuracy) -> std::optional<std::pair<double, State>> {
      LanczosOfPencil lanczos(pencil, 1, basis, known);
      if (!lanczos.find(pencil.second_start(), accuracy, most_restarts) || lanczos.found() == 0) return std::nullopt;
      return std::pair{lanczos.value(0), lanczos.vector(0)};
    };
    const double least = found[count - 1].first;
    auto more = largest(rough);
    if (!more || more->first * (1 + rough) < least) return;
    more = largest(tolerance);
    if (!more || more->first <= least * (1 + tolerance)) return;
    found.insert(std::ranges::find_if(found, [&](const auto& one) { return one.first < more->first; }), *more);
  }
}

}  // namespace

std::vector<SharedEigenvector> largest_shared_eigenvectors(const SharedPencil& given, std::size_t count,
                                                           double tolerance) {
  constexpr double none = 1e-9;  // of the largest |mu| of single points: rounding
  constexpr std::size_t most_restarts = 300;
  const FreePencil pencil(given, inner_tolerance * tolerance);
  LanczosOfPencil lanczos(pencil, Index(count), std::max<Index>(3 * Index(count) + 8, 24));
  const bool converged = lanczos.find(pencil.start(), tolerance, most_restarts);
  const double least = none * pencil.largest_of_points();
  if (!converged && lanczos.value(0) > least)
    throw NumericalError(std::string(given.purpose) + ": the Lanczos iteration does not converge");
  std::vector<std::pair<double, State>> found;
  for (Index i = 0; i < lanczos.found() && lanczos.value(i) > least; ++i)
    found.emplace_back(lanczos.value(i), lanczos.vector(i));
  if (found.size() == count) find_multiple(pencil, tolerance, found);
  std::vector<SharedEigenvector> result;
  for (std::size_t i = 0; i < std::min(count, found.size()); ++i) {
    const auto& [value, x] = found[i];
    const Forces image = pencil.stiffness_times(x);
    result.push_back(
        {value, pencil.norm(image - pencil.other_times(x) / value) / pencil.norm(image), pencil.imposed(x)});
  }
  return result;
}

std::vector<BucklingMode> distributed_buckling(const Formulation& plate, const PointMatrix& geometric,
                                               std::size_t modes, double tolerance) {
  const auto preconditioner = plate.preconditioner(Preconditioning::automatic);
  const SharedPencil pencil{.stiffness = plate,
                            .constraints = plate.constraints(),
                            .inverse = preconditioner.inverse.get(),
                            .other = geometric,
                            .share = -1,
                            .start = start_by_place(plate).value(),
                            .purpose = "buckling"};
  std::vector<BucklingMode> result;
  for (const auto& [value, residual, vector] : largest_shared_eigenvectors(pencil, modes, tolerance))
    result.push_back({1 / value, residual, normalized(plate.constraints(), vector)});
  return result;
}

}  // namespace plate
