#include "plate/solve/motion/frequencies.hpp"

#include <Spectra/SymEigsSolver.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/dense_algebra.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/section.hpp"
#include "plate/model/space.hpp"
#include "plate/solve/statics.hpp"

namespace plate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double inner_tolerance = 0.1;  // of a solution, relative to that of the eigenpairs
constexpr Index largest_restarts = 100;

/// Global sums, entry by entry, of the partial sums on each rank.
MatrixXd of_all(const Constraints& constraints, MatrixXd sums) {
  for (double& sum : sums.reshaped()) sum = sum_of_all(constraints, sum);
  return sums;
}

/// s M^(1/2) (K + sigma M)^(-1) M^(1/2), with eigenvalues s / (omega^2 + sigma) and eigenvectors M^(1/2) q, less the
/// part that belongs to eigenvectors already found. s is the power of two next to sigma: the library judges eigenvalues
/// that are far below 1 by their absolute error. Vectors have all degrees of freedom, zero at those that are held.
class Inverse {
public:
  using Scalar = double;

  Inverse(const Operator& plate, const Constraints& constraints, const Forces& mass, const FrequencyOptions& options)
      : plate_(plate),
        constraints_(constraints),
        options_(options),
        shift_(options.shift * mass),
        root_mass_(mass.cwiseSqrt()),
        scale_(std::exp2(std::round(std::log2(options.shift)))),
        solve_{options.tolerance, options.max_iterations, {}} {}

  Index rows() const { return root_mass_.size(); }
  Index cols() const { return rows(); }

  void perform_op(const double* x, double* y) const {
    if (options_.progress) options_.progress(solutions_);
    const VectorXd rest = without_found(Eigen::Map<const VectorXd>(x, rows()));
    const Forces load =
        root_mass_.cwiseProduct(Eigen::Map<const Forces>(rest.data(), unknowns_per_point, root_mass_.cols()));
    const auto solution = conjugate_gradients(plate_, constraints_, shift_, load, solve_, options_.preconditioner);
    ++solutions_;
    iterations_ += solution.iterations;
    if (!solution.converged)
      throw NumericalError("frequencies: conjugate gradients " + solution.stop_reason + " in solution " +
                           std::to_string(solutions_));
    Eigen::Map<VectorXd>(y, rows()) =
        scale_ * without_found(root_mass_.cwiseProduct(solution.state).reshaped<Eigen::RowMajor>());
  }

  void solve_to(double tolerance) { solve_.tolerance = tolerance; }

  /// A random vector at the free degrees of freedom, smoothed: white noise would stay in the residuals of the modes.
  VectorXd start(unsigned seed) const {
    std::mt19937 random(seed);
    if (constraints_.distributed()) {
      std::seed_seq own{seed, unsigned(constraints_.rank())};
      random.seed(own);
    }
    std::uniform_real_distribution<double> uniform(-1, 1);
    const VectorXd noise =
        VectorXd::NullaryExpr(rows(), [&](Index i) { return root_mass_.data()[i] > 0 ? uniform(random) : 0; });
    VectorXd smooth(rows());
    perform_op(noise.data(), smooth.data());
    return smooth;
  }

  /// Takes further eigenvectors out.
  void take_out(const MatrixXd& vectors) {
    found_.conservativeResize(rows(), found_.cols() + vectors.cols());
    found_.rightCols(vectors.cols()) = vectors;
  }

  /// Dimension of what is left.
  Index dimension() const {
    return Index(sum_of_all(constraints_, double((root_mass_.array() > 0).count()))) - found_.cols();
  }
  const Constraints& constraints() const { return constraints_; }
  const MatrixXd& found() const { return found_; }
  std::size_t solutions() const { return solutions_; }
  std::size_t iterations() const { return iterations_; }

private:
  VectorXd without_found(const VectorXd& x) const {
    if (found_.cols() == 0) return x;
    return x - found_ * of_all(constraints_, found_.transpose() * x);
  }

  const Operator& plate_;
  const Constraints& constraints_;
  const FrequencyOptions& options_;
  Forces shift_, root_mass_;
  double scale_;
  StaticOptions solve_;
  MatrixXd found_;
  mutable std::size_t solutions_ = 0, iterations_ = 0;
};

struct Ritz {
  VectorXd values;  // s / (omega^2 + sigma), largest first
  MatrixXd vectors;
};

NumericalError not_converged() {
  return NumericalError("frequencies: Lanczos iteration not converged in " + std::to_string(largest_restarts) +
                        " restarts");
}

/// Largest eigenpairs of the inverse of a distributed plate. Collective.
Ritz largest(const Inverse& inverse, const EigenpairRequest& wanted, const VectorXd& start) {
  const auto product = [&](std::span<const double> x, std::span<double> y) { inverse.perform_op(x.data(), y.data()); };
  const Communicator& all = inverse.constraints().communicator();
  const auto found = all.largest_pairs(product, {start.data(), std::size_t(start.size())}, wanted);
  if (found.values.size() < wanted.count) throw not_converged();
  Ritz result{Eigen::Map<const VectorXd>(found.values.data(), Index(wanted.count)),
              MatrixXd(start.size(), Index(wanted.count))};
  for (std::size_t i = 0; i < wanted.count; ++i)
    result.vectors.col(Index(i)) = Eigen::Map<const VectorXd>(found.vectors[i].data(), start.size());
  return result;
}

Ritz largest(Inverse& inverse, Index count, double tolerance, const VectorXd& start) {
  inverse.solve_to(inner_tolerance * tolerance);
  const Index basis = std::min(2 * count + 4, inverse.dimension());
  if (inverse.constraints().distributed())
    return largest(inverse, {std::size_t(count), std::size_t(basis), tolerance, std::size_t(largest_restarts)}, start);
  Spectra::SymEigsSolver<Inverse> lanczos(inverse, count, basis);
  lanczos.init(start.data());
  lanczos.compute(Spectra::SortRule::LargestAlge, largest_restarts, tolerance, Spectra::SortRule::LargestAlge);
  if (lanczos.info() != Spectra::CompInfo::Successful) throw not_converged();
  return {lanczos.eigenvalues(), lanczos.eigenvectors()};
}

/// Fills inverse.found() with the eigenvectors of the largest `count` eigenvalues, and perhaps some more. A Krylov
/// space holds one vector of each multiple eigenvalue, so the rest is searched for others as large until there is none.
void find(Inverse& inverse, Index count, double tolerance) {
  const double rough = std::max(tolerance, 1e-2);  // enough to see how large the largest of the rest is
  Ritz ritz = largest(inverse, count, tolerance, inverse.start(0));
  std::vector<double> values;
  for (unsigned seed = 1;; ++seed) {
    inverse.take_out(ritz.vectors);
    values.insert(values.end(), ritz.values.begin(), ritz.values.end());
    std::sort(values.begin(), values.end(), std::greater<>());
    const double least = values[static_cast<std::size_t>(count) - 1];
    if (inverse.dimension() < 2) return;
    ritz = largest(inverse, 1, rough, inverse.start(seed));
    if (ritz.values[0] * (1 + rough) < least) return;
    ritz = largest(inverse, 1, tolerance, ritz.vectors.col(0));
    if (ritz.values[0] <= least * (1 + tolerance)) return;
  }
}

/// Frequency and residual of M^(1/2) q.
class Pairs {
public:
  Pairs(const Operator& plate, const Constraints& constraints, const Forces& mass, double shift)
      : plate_(plate),
        constraints_(constraints),
        mass_(mass),
        shift_(shift),
        inverse_root_(mass.unaryExpr([](double m) { return m > 0 ? 1 / std::sqrt(m) : 0.0; })) {
    Forces diagonal = plate.diagonal();
    constraints.fold_diagonal(diagonal);
    weight_ = (diagonal + shift * mass).unaryExpr([](double d) { return d > 0 ? 1 / d : 0.0; });
  }

  State state(const VectorXd& y) const {
    State u = inverse_root_.cwiseProduct(Eigen::Map<const State>(y.data(), unknowns_per_point, inverse_root_.cols()));
    constraints_.impose(u);
    return u;
  }

  Forces stiffness_times(const State& u) const {
    Forces force;
    plate_.internal_force(u, force);
    constraints_.fold(force);
    return -force;
  }

  Mode mode(double square, const State& u) const {
    const Forces inertia = mass_.cwiseProduct(u), rest = stiffness_times(u) - square * inertia;
    const auto norm = [&](const Forces& f) {
      return std::sqrt(sum_of_all(constraints_, f.cwiseAbs2().cwiseProduct(weight_).sum()));
    };
    const double residual = norm(rest) / ((square + shift_) * norm(inertia));
    return {std::sqrt(std::max(square, 0.0)) / (2 * std::numbers::pi), residual, normalized(constraints_, u)};
  }

private:
  const Operator& plate_;
  const Constraints& constraints_;
  const Forces& mass_;
  double shift_;
  Forces inverse_root_, weight_;
};

}  // namespace

State normalized(const Constraints& constraints, State state) {
  if (constraints.distributed()) {
    const double high = largest_of(constraints, state.row(0).maxCoeff()),
                 low = largest_of(constraints, -state.row(0).minCoeff());
    if (std::max(high, low) > 0) state /= high >= low ? high : -low;
    return state;
  }
  Index at = 0;
  const double w = state.row(0).cwiseAbs().maxCoeff(&at);
  if (w > 0) state /= state(0, at);
  return state;
}

double shift_of(const Section& section, double length) {
  return section.bending_stiffness() / section.mass() * std::pow(std::numbers::pi / length, 4);
}

FrequencySolution frequencies(const Operator& plate, const Constraints& constraints, const Forces& mass,
                              const FrequencyOptions& options) {
  Inverse inverse(plate, constraints, mass, options);
  const auto count = static_cast<Index>(options.modes);
  if (!(options.shift > 0)) throw std::invalid_argument("frequencies: the shift must be positive");
  if (count < 1 || count >= inverse.dimension())
    throw std::invalid_argument("frequencies: a plate of " + std::to_string(inverse.dimension()) +
                                " degrees of freedom does not have " + std::to_string(count) + " modes to find");
  find(inverse, count, options.tolerance);

  // Rayleigh and Ritz: the best that the space of all vectors found can give, their errors squared
  const MatrixXd& found = inverse.found();
  const Pairs pairs(plate, constraints, mass, options.shift);
  MatrixXd stiffness(found.cols(), found.cols());
  for (Index i = 0; i < found.cols(); ++i) {
    const Forces force = pairs.stiffness_times(pairs.state(found.col(i)));
    for (Index j = 0; j < found.cols(); ++j) stiffness(j, i) = force.cwiseProduct(pairs.state(found.col(j))).sum();
  }
  stiffness = of_all(constraints, std::move(stiffness));
  const Eigenpairs eigen =
      eigenpairs((stiffness + stiffness.transpose()) / 2, of_all(constraints, found.transpose() * found));
  FrequencySolution result{{}, inverse.solutions(), inverse.iterations()};
  constexpr double no_mode = 0.3;  // residual
  for (Index i = 0; i < count; ++i) {
    result.modes.push_back(pairs.mode(eigen.values[i], pairs.state(found * eigen.vectors.col(i))));
    if (const double residual = result.modes.back().residual; residual > no_mode)
      throw NumericalError(fmt::format("frequencies: mode {} has a residual of {:.2g}", i + 1, residual));
  }
  return result;
}

}  // namespace plate
