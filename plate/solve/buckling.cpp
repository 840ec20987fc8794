#include "plate/solve/buckling.hpp"

#include <Spectra/SymGEigsSolver.h>
#include <algorithm>
#include <cmath>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/errors.hpp"
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

/// -K_g.
class Softening {
public:
  using Scalar = double;
  Softening(const Matrix& geometric, const Constraints& constraints)
      : geometric_(geometric), constraints_(constraints) {}

  Eigen::Index rows() const { return geometric_.rows(); }
  Eigen::Index cols() const { return geometric_.cols(); }
  void perform_op(const double* x, double* y) const {
    stop_if_asked("buckling", constraints_);
    Eigen::Map<VectorXd>(y, rows()) = -product(geometric_, x);
  }

private:
  const Matrix& geometric_;
  const Constraints& constraints_;
};

/// K and its inverse.
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

std::vector<BucklingMode> buckling(const Formulation& plate, const PointMatrix& geometric, std::size_t modes,
                                   double tolerance) {
  if (plate.distributed()) return distributed_buckling(plate, geometric, modes, tolerance);
  constexpr double none = 1e-9;  // of the largest |1 / factor| of single points: rounding
  constexpr Eigen::Index most_restarts = 300;
  const auto folded_stiffness = folded(plate.stiffness(), plate.constraints());
  const Forces diagonal = folded_diagonal(plate, plate.constraints());
  const auto all = unknowns(diagonal, elimination_order(folded_stiffness, diagonal));
  if (all.size() < 2) return {};
  const Matrix K = of_unknowns(folded_stiffness, all), K_g = of_unknowns(folded(geometric, plate.constraints()), all);
  Softening softening(K_g, plate.constraints());
  Stiffness stiffness(K);
  const auto count = std::min<Eigen::Index>(Eigen::Index(modes), K.rows() - 1);
  const auto basis = std::min<Eigen::Index>(std::max<Eigen::Index>(3 * count + 8, 24), K.rows());
  Spectra::SymGEigsSolver<Softening, Stiffness, Spectra::GEigsMode::RegularInverse> lanczos(softening, stiffness, count,
                                                                                            basis);
  lanczos.init();
  lanczos.compute(Spectra::SortRule::LargestAlge, most_restarts, tolerance, Spectra::SortRule::LargestAlge);
  if (lanczos.info() != Spectra::CompInfo::Successful)
    throw NumericalError("buckling: the Lanczos iteration does not converge");
  const VectorXd weight = K.diagonal().cwiseInverse();
  const auto norm = [&](const VectorXd& force) { return std::sqrt(force.cwiseAbs2().dot(weight)); };
  const VectorXd inverse_factors = lanczos.eigenvalues();
  const Eigen::MatrixXd vectors = lanczos.eigenvectors();
  const double largest = K_g.diagonal().cwiseAbs().cwiseProduct(weight).maxCoeff();
  std::vector<BucklingMode> result;
  for (Eigen::Index i = 0; i < inverse_factors.size(); ++i) {
    if (!(inverse_factors[i] > none * largest)) break;
    const VectorXd x = vectors.col(i), bent = product(K, x.data());
    const double factor = 1 / inverse_factors[i];
    result.push_back({factor, norm(bent + factor * product(K_g, x.data())) / norm(bent), shape_of(x, all, plate)});
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
