#include "plate/solve/buckling.hpp"

#include <Spectra/SymGEigsSolver.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/frequencies.hpp"
#include "plate/solve/statics.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {
namespace {

using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// Product with a symmetric matrix, of which there is the lower triangle.
VectorXd product(const Matrix& lower, const double* x) {
  return lower.selfadjointView<Eigen::Lower>() * Eigen::Map<const VectorXd>(x, lower.rows());
}

/// A, less what belongs to eigenvectors already found.
class Left {
public:
  using Scalar = double;
  /// `scale`: of the eigenvalues.
  Left(const Matrix& lower, double scale, const std::string& purpose, const Constraints& constraints)
      : lower_(lower), scale_(scale), purpose_(purpose), constraints_(constraints) {}

  Eigen::Index rows() const { return lower_.rows(); }
  Eigen::Index cols() const { return lower_.cols(); }
  void perform_op(const double* x, double* y) const {
    stop_if_asked(purpose_.c_str(), constraints_);
    Eigen::Map<VectorXd> result(y, rows());
    result = scale_ * product(lower_, x);
    if (values_.size() > 0)
      result -= times_B_ * values_.cwiseProduct(times_B_.transpose() * Eigen::Map<const VectorXd>(x, rows()));
  }
  /// `times_B`: B x of the eigenvectors.
  void take_out(VectorXd values, Eigen::MatrixXd times_B) {
    values_ = std::move(values), times_B_ = std::move(times_B);
  }

private:
  const Matrix& lower_;
  double scale_;
  const std::string& purpose_;
  const Constraints& constraints_;
  VectorXd values_;
  Eigen::MatrixXd times_B_;
};

/// B and its inverse.
class Stiffness {
public:
  using Scalar = double;
  explicit Stiffness(const Matrix& lower) : lower_(lower), factor_(lower) {}

  Eigen::Index rows() const { return lower_.rows(); }
  Eigen::Index cols() const { return lower_.cols(); }
  void perform_op(const double* x, double* y) const { Eigen::Map<VectorXd>(y, rows()) = product(lower_, x); }
  void solve(const double* x, double* y) const {
    Eigen::Map<VectorXd>(y, rows()) = factor_.solve(Eigen::Map<const VectorXd>(x, rows()));
  }

private:
  const Matrix& lower_;
  Factor factor_;
};

bool is_positive(const Matrix& lower) {
  try {
    return Factor(lower).bytes() > 0;
  } catch (const NotPositive&) {
    return false;
  }
}

/// The state of the unknowns with the largest |w| of 1.
State shape_of(const VectorXd& values, const Unknowns& unknowns, const Formulation& plate) {
  State result = zero_state(plate.points());
  for (Eigen::Index u = 0; u < values.size(); ++u) at_dof(result, unknowns.dof[std::size_t(u)]) = values[u];
  plate.constraints().impose(result);
  Eigen::Index at = 0;
  if (result.row(0).cwiseAbs().maxCoeff(&at) > 0) result /= result(0, at);
  return result;
}

}  // namespace

Eigenvectors largest_eigenvectors(const Matrix& A, const Matrix& B, std::size_t wanted, double tolerance,
                                  const std::string& purpose, const Constraints& constraints) {
  constexpr Eigen::Index most_restarts = 300;
  constexpr double rough = 1e-2;  // enough to see how large the largest of the rest is
  // a power of two: the library judges eigenvalues that are far below 1 by their absolute error
  const double usual = A.diagonal().cwiseAbs().sum() / B.diagonal().cwiseAbs().sum();
  const double scale = usual > 0 ? std::exp2(-std::round(std::log2(usual))) : 1;
  Left left(A, scale, purpose, constraints);
  Stiffness factor(B);
  std::size_t solutions = 0;
  const auto search = [&](Eigen::Index count, double accuracy, const double* start) -> Eigenvectors {
    const auto basis = std::min<Eigen::Index>(std::max<Eigen::Index>(3 * count + 8, 24), B.rows());
    Spectra::SymGEigsSolver<Left, Stiffness, Spectra::GEigsMode::RegularInverse> lanczos(left, factor, count, basis);
    if (start)
      lanczos.init(start);
    else
      lanczos.init();
    try {
      lanczos.compute(Spectra::SortRule::LargestAlge, most_restarts, accuracy, Spectra::SortRule::LargestAlge);
    } catch (const std::logic_error&) {
      throw;
    } catch (const std::runtime_error& error) {  // of the small problem
      throw NumericalError(fmt::format("{}: {}", purpose, error.what()));
    }
    if (lanczos.info() != Spectra::CompInfo::Successful)
      throw NumericalError(purpose + ": the Lanczos iteration does not converge");
    solutions += std::size_t(lanczos.num_operations());
    return {lanczos.eigenvalues(), lanczos.eigenvectors()};
  };
  const auto count = std::min<Eigen::Index>(Eigen::Index(wanted), B.rows() - 1);
  auto result = search(count, tolerance, nullptr);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  while (result.values.size() < B.rows() - 1) {  // a Krylov space holds one vector of each multiple eigenvalue
    const double least = result.values[count - 1];
    if (least <= 0) break;
    left.take_out(result.values, B.selfadjointView<Eigen::Lower>() * result.vectors);
    const VectorXd start = VectorXd::NullaryExpr(B.rows(), [&](Eigen::Index) { return uniform(random); });
    auto more = search(1, rough, start.data());
    if (more.values[0] * (1 + rough) < least) break;
    more = search(1, tolerance, start.data());  // from an eigenvector the iteration would break down
    if (more.values[0] <= least * (1 + tolerance)) break;
    const auto before = result.values.size();
    Eigen::Index at = 0;
    while (at < before && result.values[at] >= more.values[0]) ++at;
    result.values.conservativeResize(before + 1), result.vectors.conservativeResize(B.rows(), before + 1);
    for (auto i = before; i > at; --i)
      result.values[i] = result.values[i - 1], result.vectors.col(i) = result.vectors.col(i - 1).eval();
    result.values[at] = more.values[0], result.vectors.col(at) = more.vectors.col(0);
  }
  return {result.values.head(count) / scale, result.vectors.leftCols(count), solutions};
}

std::vector<BucklingMode> buckling(const Formulation& plate, const PointMatrix& geometric, std::size_t modes,
                                   double tolerance) {
  if (plate.distributed()) return distributed_buckling(plate, geometric, modes, tolerance);
  constexpr double none = 1e-9;    // of the largest |1 / factor| of single points: rounding
  constexpr double far_off = 1e3;  // tolerances: a residual that is not that of a mode
  constexpr double beyond = 1e3;   // factors at which single points buckle: above those of plates
  const auto folded_stiffness = folded(plate.stiffness(), plate.constraints());
  const Forces diagonal = folded_diagonal(plate, plate.constraints());
  const auto all = unknowns(diagonal, elimination_order(folded_stiffness, diagonal));
  if (all.size() < 2) return {};
  const Matrix K = of_unknowns(folded_stiffness, all), K_g = of_unknowns(folded(geometric, plate.constraints()), all);
  const VectorXd weight = K.diagonal().cwiseInverse();
  const auto norm = [&](const VectorXd& force) { return std::sqrt(force.cwiseAbs2().dot(weight)); };
  const double largest = K_g.diagonal().cwiseAbs().cwiseProduct(weight).maxCoeff();
  if (!(largest > 0)) return {};
  const Matrix softest = K + beyond / largest * K_g;
  if (is_positive(softest)) return {};
  const auto find = [&](std::size_t count) {
    return largest_eigenvectors(Matrix(-K_g), K, count, tolerance, "buckling", plate.constraints());
  };
  const auto find_all = [&]() -> Eigenvectors {
    try {
      return find(modes);
    } catch (const NumericalError&) {
      // there may be fewer, or far larger negative ones hide them: with a shift below the first factor these stay small
      double shift = beyond / largest;
      while (!is_positive(K + shift * K_g)) shift /= 2;
      auto found =
          largest_eigenvectors(Matrix(-K_g), K + shift * K_g, std::min(modes, Factor::of_any_sign(softest).negative()),
                               tolerance, "buckling", plate.constraints());
      found.values = found.values.cwiseQuotient((1 + shift * found.values.array()).matrix());
      return found;
    }
  };
  const auto [inverse_factors, vectors, solutions] = find_all();
  std::vector<BucklingMode> result;
  for (Eigen::Index i = 0; i < inverse_factors.size(); ++i) {
    if (!(inverse_factors[i] > none * largest)) break;
    const VectorXd x = vectors.col(i), bent = product(K, x.data());
    const double factor = 1 / inverse_factors[i];
    const double residual = norm(bent + factor * product(K_g, x.data())) / norm(bent);
    if (residual > std::max(far_off * tolerance, 1e-4))
      throw NumericalError(fmt::format("buckling: mode {} has a residual of {:.2g}", i + 1, residual));
    result.push_back({factor, residual, shape_of(x, all, plate)});
  }
  return result;
}

PointMatrix prestress(const Formulation& membrane) {
  constexpr double tolerance = 1e-9;
  constexpr std::size_t iterations = 1000;
  const auto found = solve_static(membrane, membrane.total_load(), StaticMethod::cg, Preconditioning::automatic,
                                  {tolerance, iterations, {}});
  if (!found.solution.converged) throw NumericalError("in the plane: " + found.solution.stop_reason);
  const auto stretching = membrane.stretching();
  auto result = stretching->geometric_stiffness(found.solution.state);
  if (std::ranges::any_of(membrane.problem().stiffeners, &Stiffener::stretches))
    result = membrane.with_coupling_forces(std::move(result), zero_like(found.solution.state), found.solution.state);
  if (const auto heat = heat_of(membrane, 1); !heat.none())
    add(stretching->stiffness_of_heat(heat.curvature), 1, result);
  return result;
}

FrequencySolution frequencies_under_load(const Formulation& membrane, const Formulation& plate, const Forces& mass,
                                         const FrequencyOptions& options) {
  const auto geometric = prestress(membrane);
  const StressedPlate stressed(plate, geometric);
  const char* const buckled =
      "the plate buckles below these loads and has no frequencies: find them by kind = \"buckling\"";
  try {
    auto result = frequencies(stressed, plate.constraints(), mass, options);
    if (plate.held() && std::ranges::any_of(result.modes, [](const auto& mode) { return mode.frequency == 0; }))
      throw NumericalError(buckled);
    return result;
  } catch (const NotPositive&) {
    throw NumericalError(buckled);
  }
}

void StressedPlate::internal_force(const State& state, Forces& forces) const {
  plate_.internal_force(state, forces);
  for (std::uint32_t c = 0; c < geometric_.points(); ++c)
    for (auto at = geometric_.first[c]; at < geometric_.first[c + 1]; ++at) {
      const auto r = geometric_.row[at];
      forces.col(r) -= geometric_.block[at] * state.col(c);
      if (r != c) forces.col(c) -= geometric_.block[at].transpose() * state.col(r);
    }
}

void StressedPlate::absolute_product(const State& state, Forces& forces) const {
  plate_.absolute_product(state, forces);
  for (std::uint32_t c = 0; c < geometric_.points(); ++c)
    for (auto at = geometric_.first[c]; at < geometric_.first[c + 1]; ++at) {
      const auto r = geometric_.row[at];
      forces.col(r) += geometric_.block[at].cwiseAbs() * state.col(c);
      if (r != c) forces.col(c) += geometric_.block[at].transpose().cwiseAbs() * state.col(r);
    }
}

Forces StressedPlate::diagonal() const {
  Forces result = plate_.diagonal();
  for (std::size_t k = 0; k < geometric_.points(); ++k)
    result.col(Eigen::Index(k)) += geometric_.block[geometric_.first[k]].diagonal();
  return result;
}

}  // namespace plate
