#include <algorithm>
#include <cmath>
#include <numeric>

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

/// K and K_g of a distributed plate, on the free degrees of freedom; all others of a vector are zero. Collective.
class BucklingPencil {
public:
  BucklingPencil(const Formulation& plate, const PointMatrix& geometric, double tolerance)
      : plate_(plate),
        geometric_(geometric),
        preconditioner_(plate.preconditioner(Preconditioning::automatic)),
        options_{tolerance, most_iterations, {}},
        weight_(folded_diagonal(plate, constraints()).unaryExpr([](double d) { return d > 0 ? 1 / d : 0.0; })) {}

  const Constraints& constraints() const { return plate_.constraints(); }
  State free(const State& state) const { return (weight_.array() > 0).select(state, 0.0); }
  State imposed(State vector) const {
    constraints().impose(vector);
    return vector;
  }
  Forces stiffness_times(const State& vector) const {
    Forces force;
    plate_.internal_force(imposed(vector), force);
    constraints().fold(force);
    return free(-force);
  }
  /// -K_g of the vector.
  Forces softened(const State& vector) const {
    Forces force = -product(geometric_, imposed(vector));
    constraints().fold(force);
    return free(force);
  }
  State solved(const Forces& load) const {
    stop_if_asked("buckling", constraints());
    auto found = conjugate_gradients(plate_, constraints(), load, options_, preconditioner_.inverse.get());
    if (!found.converged) throw NumericalError("buckling: conjugate gradients " + found.stop_reason);
    return free(found.state);
  }
  /// Smooth and of all modes.
  State start() const { return solved(free(start_by_place(plate_).value())); }
  double dot(const State& a, const State& b) const {
    return ordered_sum<1>(plate_, std::size_t(a.size()),
                          [&](std::size_t i) { return std::array<double, 1>{a.data()[i] * b.data()[i]}; })[0];
  }
  double norm(const Forces& force) const { return std::sqrt(dot(force.cwiseProduct(weight_), force)); }
  /// Largest |1 / factor| of single points.
  double largest_of_points() const {
    Forces diagonal = zero_forces(geometric_.points());
    for (std::size_t k = 0; k < geometric_.points(); ++k)
      diagonal.col(Index(k)) = geometric_.block[geometric_.first[k]].diagonal();
    constraints().fold_diagonal(diagonal);
    return largest_of(plate_, diagonal.cwiseAbs().cwiseProduct(weight_).maxCoeff());
  }

private:
  const Formulation& plate_;
  const PointMatrix& geometric_;
  ChosenPreconditioner preconditioner_;
  StaticOptions options_;
  Forces weight_;
};

/// Lanczos vectors of K^-1 (-K_g), orthonormal by K, with restarts that keep the best of them.
class LanczosOfPencil {
public:
  LanczosOfPencil(const BucklingPencil& pencil, Index count, Index basis)
      : pencil_(pencil), count_(count), basis_(basis) {}

  /// Goes on until the largest pairs are known; false where they are not in so many restarts.
  bool find(double tolerance, std::size_t most_restarts) {
    State next = pencil_.start();
    for (std::size_t restart = 0; restart <= most_restarts; ++restart) {
      double left = orthogonal(next);
      while (left > 0 && Index(vectors_.size()) < basis_) {
        add(next / left);
        next = pencil_.solved(softened_), left = orthogonal(next);
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
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i < vectors_.size(); ++i) next -= pencil_.dot(images_[i], next) * vectors_[i];
    const double left = std::sqrt(pencil_.dot(next, pencil_.stiffness_times(next)));
    return left > rounding * before ? left : 0;
  }

  void add(State vector) {
    images_.push_back(pencil_.stiffness_times(vector));
    softened_ = pencil_.softened(vector);
    vectors_.push_back(std::move(vector));
    const auto size = Index(vectors_.size());
    projected_.conservativeResize(size, size);
    for (Index i = 0; i < size; ++i)
      projected_(i, size - 1) = projected_(size - 1, i) = pencil_.dot(vectors_[std::size_t(i)], softened_);
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

  const BucklingPencil& pencil_;
  Index count_, basis_;
  std::vector<State> vectors_, images_;  // images: by K
  Forces softened_;                      // of the last vector
  MatrixXd projected_;
  Eigenpairs ritz_{};
};

}  // namespace

std::vector<BucklingMode> distributed_buckling(const Formulation& plate, const PointMatrix& geometric,
                                               std::size_t modes, double tolerance) {
  constexpr double none = 1e-9;  // of the largest |1 / factor| of single points: rounding
  constexpr std::size_t most_restarts = 300;
  const BucklingPencil pencil(plate, geometric, inner_tolerance * tolerance);
  const auto count = Index(modes);
  LanczosOfPencil lanczos(pencil, count, std::max<Index>(3 * count + 8, 24));
  const bool converged = lanczos.find(tolerance, most_restarts);
  const double least = none * pencil.largest_of_points();
  if (!converged && lanczos.value(0) > least) throw NumericalError("buckling: the Lanczos iteration does not converge");
  std::vector<BucklingMode> result;
  for (Index i = 0; i < lanczos.found() && lanczos.value(i) > least; ++i) {
    const double factor = 1 / lanczos.value(i);
    const State x = lanczos.vector(i);
    const Forces bent = pencil.stiffness_times(x);
    result.push_back({factor, pencil.norm(bent - factor * pencil.softened(x)) / pencil.norm(bent),
                      normalized(plate.constraints(), pencil.imposed(x))});
  }
  return result;
}

}  // namespace plate
