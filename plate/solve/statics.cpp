#include "plate/solve/statics.hpp"

#include <fmt/format.h>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/factorised_plate.hpp"
#include "plate/solve/interruption.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/plate_in_contact.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/pushing_supports.hpp"

namespace plate {
namespace {

constexpr std::size_t report_every = 50;

/// 1 / d at free degrees of freedom that have stiffness, 0 at all others; d = diag(P^T diag(K) P).
Forces inverse(const Forces& diagonal) {
  return diagonal.unaryExpr([](double d) { return d > 0 ? 1 / d : 0.0; });
}

/// 1 / lambda of Dai 14: the diagonal, scaled so that no frequency exceeds 2 with time step 1.
Forces inverse_fictitious_mass(const Operator& plate, const Constraints& constraints, const Forces& diagonal,
                               const std::optional<State>& start) {
  const double step = stable_time_step(plate, constraints, diagonal, start);
  return inverse(diagonal) * (step * step);
}

double weighted_norm(const Constraints& constraints, const Forces& forces, const Forces& weight) {
  const auto [sum] = ordered_sum<1>(constraints, static_cast<std::size_t>(forces.size()), [&](std::size_t i) {
    return std::array<double, 1>{forces.data()[i] * forces.data()[i] * weight.data()[i]};
  });
  return std::sqrt(sum);
}

/// Scalar product over all ranks.
double dot(const Constraints& constraints, const State& a, const Forces& b) {
  return ordered_sum<1>(constraints, std::size_t(a.size()),
                        [&](std::size_t i) { return std::array<double, 1>{a.data()[i] * b.data()[i]}; })[0];
}

/// Checks before an iteration: throws where its residual is not finite, or a signal asks for the end.
void may_go_on(const Constraints& constraints, double residual, const char* method, std::size_t iteration) {
  constexpr std::size_t seldom = 20;  // ranks of a distributed plate stop together, and ask each other
  if (!constraints.distributed() || iteration % seldom == 0) stop_if_asked(method, constraints);
  if (!std::isfinite(residual))
    throw NumericalError(std::string(method) + ": the residual is not finite at iteration " +
                         std::to_string(iteration));
}

std::string reason(bool converged, const StaticOptions& options) {
  return converged ? "residual below tolerance"
                   : "not converged in " + std::to_string(options.max_iterations) + " iterations";
}

/// Adds the forces -K `state` to the forces `residual` on degrees of freedom that have a weight.
template <typename Product>
void leave(const Product& minus_k, State state, const Forces& weight, Forces& residual) {
  Forces product;
  minus_k(state, product);
  residual += product.cwiseProduct((weight.array() > 0).cast<double>().matrix());
}

/// Conjugate gradients for a stiffness that is given by product(direction, forces): forces = -K direction, folded.
/// `weight`: the inverse of its diagonal; the preconditioner where there is no other.
template <typename Product>
StaticSolution iterate(const Product& minus_k, const Constraints& constraints, const Forces& weight,
                       const Preconditioner* preconditioner, const Forces& load, const StaticOptions& options,
                       const State* start = nullptr) {
  const auto size = static_cast<std::size_t>(load.size());
  Forces residual = load;
  constraints.fold(residual);
  residual = residual.array() * (weight.array() > 0).cast<double>();
  const double load_norm = weighted_norm(constraints, residual, weight);

  StaticSolution result;
  result.state = zero_like(load);
  if (load_norm == 0) return {result.state, 0, 0, true, "no load reaches a free degree of freedom"};
  State correction, direction = zero_like(load);
  Forces product;
  double norm = load_norm, rho = 0;
  if (start)
    leave(minus_k, result.state = *start, weight, residual), norm = weighted_norm(constraints, residual, weight);
  double *u = result.state.data(), *r = residual.data(), *p = direction.data();
  const double* d = weight.data();

  for (result.iterations = 0;; ++result.iterations) {
    result.residual = norm / load_norm;
    may_go_on(constraints, result.residual, "conjugate gradients", result.iterations);
    if (options.progress && result.iterations % report_every == 0) options.progress(result.iterations, result.residual);
    result.converged = result.residual <= options.tolerance;
    if (result.converged || result.iterations == options.max_iterations) break;

    double rho_next = norm * norm;
    if (preconditioner) {
      preconditioner->apply(residual, correction);
      rho_next = dot(constraints, correction, residual);
    }
    const double beta = rho > 0 ? rho_next / rho : 0;
    rho = rho_next;
    const double* z = preconditioner ? correction.data() : nullptr;
#pragma omp parallel for simd schedule(static)
    for (std::size_t i = 0; i < size; ++i) p[i] = (z ? z[i] : d[i] * r[i]) + beta * p[i];

    minus_k(direction, product);
    const double* minus_kp = product.data();
    const auto [curvature] = ordered_sum<1>(constraints, size, [&](std::size_t i) {
      return std::array<double, 1>{-p[i] * minus_kp[i]};  // zero at held degrees of freedom
    });
    if (!(curvature > 0))
      throw NotPositive("conjugate gradients: the stiffness is not positive at iteration " +
                        std::to_string(result.iterations));
    const double alpha = rho / curvature;
#pragma omp parallel for simd schedule(static)
    for (std::size_t i = 0; i < size; ++i) {
      const double moved = d[i] > 0 ? alpha : 0;
      u[i] += moved * p[i];
      r[i] += moved * minus_kp[i];
    }
    norm = weighted_norm(constraints, residual, weight);
  }
  constraints.impose(result.state);
  result.stop_reason = reason(result.converged, options);
  return result;
}

}  // namespace

StaticSolution adaptive_dynamic_relaxation(const Operator& plate, const Constraints& constraints, const Forces& load,
                                           const StaticOptions& options) {
  const auto size = static_cast<std::size_t>(load.size());
  const Forces diagonal = folded_diagonal(plate, constraints), weight = inverse(diagonal);
  const Forces inverse_mass = inverse_fictitious_mass(plate, constraints, diagonal, options.start_of_bound);
  Forces external = load;
  constraints.fold(external);
  const double load_norm = weighted_norm(constraints, external, weight);

  StaticSolution result;
  result.state = zero_like(load);
  if (load_norm == 0) return {result.state, 0, 0, true, "no load reaches a free degree of freedom"};
  State velocity = zero_like(load);
  Forces force, previous = zero_like(load);
  double* u = result.state.data();
  double* v = velocity.data();
  double* a_before = previous.data();  // acceleration F / lambda of the step before

  for (result.iterations = 0;; ++result.iterations) {
    plate.internal_force(result.state, force);
    constraints.fold(force);
    const double* f = force.data();
    // squared residual; u K u and u u of Dai 19 with the fictitious mass, so that w and rotations may be added
    const auto [residual, stiffness, mass] = ordered_sum<3>(constraints, size, [&](std::size_t i) {
      const double total = f[i] + external.data()[i];
      const double inverse = inverse_mass.data()[i];
      if (inverse == 0) return std::array<double, 3>{0, 0, 0};
      const double local = v[i] == 0 ? 0 : -(total * inverse - a_before[i]) / v[i];  // Dai 20
      const double square = u[i] * u[i] / inverse;
      return std::array<double, 3>{total * total * weight.data()[i], square * local, square};
    });
    result.residual = std::sqrt(residual) / load_norm;
    may_go_on(constraints, result.residual, "adaptive dynamic relaxation", result.iterations);
    if (options.progress && result.iterations % report_every == 0) options.progress(result.iterations, result.residual);
    result.converged = result.residual <= options.tolerance;
    if (result.converged || result.iterations == options.max_iterations) break;

    const bool first = result.iterations == 0;
    const double c = stiffness > 0 && mass > 0 ? std::min(2 * std::sqrt(stiffness / mass), 1.9) : 0;  // Dai 19
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < size; ++i) {
      const double a = (f[i] + external.data()[i]) * inverse_mass.data()[i];
      v[i] = first ? a / 2 : ((2 - c) * v[i] + 2 * a) / (2 + c);  // Dai 18, 16
      u[i] += v[i];                                               // Dai 17
      a_before[i] = a;
    }
    constraints.impose(result.state);
  }
  result.stop_reason = reason(result.converged, options);
  return result;
}

StaticSolution conjugate_gradients(const Operator& plate, const Constraints& constraints, const Forces& load,
                                   const StaticOptions& options, const Preconditioner* preconditioner,
                                   const State* start) {
  const auto product = [&](State& direction, Forces& forces) {
    PendingExchange rest(constraints, direction);
    plate.internal_force_overlapped(direction, rest, forces);
    constraints.fold(forces);
  };
  const Forces weight = inverse(folded_diagonal(plate, constraints));
  return iterate(product, constraints, weight, preconditioner, load, options, start);
}

StaticSolution conjugate_gradients(const Operator& plate, const Constraints& constraints, const Forces& shift,
                                   const Forces& load, const StaticOptions& options,
                                   const Preconditioner* preconditioner) {
  const auto product = [&](State& direction, Forces& forces) {
    PendingExchange rest(constraints, direction);
    plate.internal_force_overlapped(direction, rest, forces);
    constraints.fold(forces);
    forces -= shift.cwiseProduct(direction);
  };
  const Forces weight = inverse(folded_diagonal(plate, constraints) + shift);
  return iterate(product, constraints, weight, preconditioner, load, options);
}

StaticSolution refined(const Operator& plate, const Constraints& constraints, const Forces& load,
                       const StaticOptions& options, const Preconditioner& inverse_of_plate) {
  constexpr std::size_t most = 10;  // each leaves 1e-10 or so of the residual before
  const Forces weight = inverse(folded_diagonal(plate, constraints));
  Forces external = load;
  constraints.fold(external);
  external = external.array() * (weight.array() > 0).cast<double>();
  const double load_norm = weighted_norm(constraints, external, weight);
  StaticSolution result;
  result.state = zero_like(load);
  if (load_norm == 0) return {result.state, 0, 0, true, "no load reaches a free degree of freedom"};
  Forces residual = external, internal;
  State correction;
  for (;; ++result.iterations) {
    result.residual = weighted_norm(constraints, residual, weight) / load_norm;
    may_go_on(constraints, result.residual, "the factor of the plate", result.iterations);
    result.converged = result.residual <= options.tolerance;
    if (result.converged || result.iterations == std::min(most, options.max_iterations)) break;
    inverse_of_plate.apply(residual, correction);
    result.state += correction;
    constraints.impose(result.state);
    plate.internal_force(result.state, internal);
    constraints.fold(internal);
    residual = (external + internal).array() * (weight.array() > 0).cast<double>();
  }
  result.stop_reason = result.converged ? "residual below tolerance" : "the factor of the plate does not solve it";
  return result;
}

StaticResult solve_static(const Formulation& plate, const Forces& load, StaticMethod method, Preconditioning wanted,
                          const StaticOptions& options, const State& lift) {
  return StaticSolver(plate, method, wanted)(load, options, false, lift);
}

StaticResult static_solution(const Formulation& plate, const Analysis& analysis, const StaticOptions& options) {
  return solve_static(plate, acting_load(plate), analysis.static_method(), analysis.preconditioner, options,
                      total_lift(plate));
}

State start_of(const Formulation& plate, const Analysis& analysis) {
  const auto load = plate.first_load();
  const auto lift = first_lift(plate);
  if (largest_of(plate, load.isZero(0) && lift.isZero(0) ? 0 : 1) == 0) return {};
  const auto result = solve_static(plate, load, analysis.static_method(), analysis.preconditioner,
                                   {StaticOptions{}.tolerance, analysis.max_iterations, {}}, lift);
  if (!result.solution.converged)
    throw NumericalError(fmt::format("the plate at the start: {}, residual {:.2e}", result.solution.stop_reason,
                                     result.solution.residual));
  return result.solution.state;
}

std::unique_ptr<Preconditioner> inverse_of(const Formulation& plate) {
  constexpr std::size_t many = 100000;  // points
  if (plate.points() <= many || !plate.offers(Feature::levels)) return plate.factor();
  return plate.preconditioner(Preconditioning::automatic).inverse;
}

StaticSolver::StaticSolver(const Formulation& plate, StaticMethod method, Preconditioning wanted)
    : plate_(&plate), method_(method) {
  if (plate.problem().pushed()) pushing_ = std::make_unique<PushingSupports>(plate);
  if (method == StaticMethod::direct) inverse_ = plate.factor();
  if (method != StaticMethod::cg) return;
  auto [inverse, name] = plate.preconditioner(wanted);
  inverse_ = std::move(inverse), name_ = std::move(name);
}

StaticSolver::~StaticSolver() = default;

StaticResult StaticSolver::solved(const Operator& plate, const Forces& load, const StaticOptions& options, bool again,
                                  const State* start) {
  constexpr std::size_t most = 24;  // of what is kept
  const auto& constraints = plate_->constraints();
  const std::size_t bytes = inverse_ ? inverse_->bytes() : 0;
  if (method_ == StaticMethod::adr) {
    auto from = options;
    from.start_of_bound = start_by_place(*plate_);
    return {adaptive_dynamic_relaxation(plate, constraints, load, from), "adr", {}, 0};
  }
  if (method_ == StaticMethod::direct) {
    const auto solution = plate_->offers(Feature::symmetry)
                              ? conjugate_gradients(plate, constraints, load, options, inverse_.get(), start)
                              : refined(plate, constraints, load, options, *inverse_);
    return {solution, "direct", {}, bytes};
  }
  Forces folded = load;
  constraints.fold(folded);
  const auto near = start ? std::optional(*start) : nearest(states_, forces_, folded, constraints);
  StaticResult result{conjugate_gradients(plate, constraints, load, options, inverse_.get(), near ? &*near : nullptr),
                      "cg", name_, bytes};
  if (again && states_.size() < most) {
    states_.push_back(result.solution.state);
    plate.internal_force(states_.back(), forces_.emplace_back());
    constraints.fold(forces_.back());
  }
  return result;
}

StaticResult StaticSolver::in_contact(const Forces& load, const StaticOptions& options, const State& lift) {
  const auto& elastic_supports = plate_->boundary().elastic_supports;
  StaticResult result;
  const RestOnSoil rest{
      .solve =
          [&](const ContactState& touching, const State* start) {
            result = lifted(PlateInContact(*plate_, elastic_supports, touching), load, options, false, lift, start);
            return std::move(result.solution);
          },
      .touching = [&](const State& now) { return elastic_supports.touching(now); },
      .energy = [&](const State& now) { return plate_->strain_energy(now) + potential(*plate_, load, now); }};
  result.solution = contact_with_soil(*plate_, rest);
  if (result.solution.converged) require_contact(*plate_, load, lift, result.solution.state);
  return result;
}

StaticResult StaticSolver::lifted(const Operator& plate, const Forces& load, const StaticOptions& options, bool again,
                                  const State& lift, const State* start) {
  if (lift.cols() == 0) return solved(plate, load, options, again, start);
  constexpr int most = 4;
  const PrescribedDisplacements prescribed(*plate_, load, lift, &plate);
  const auto beside = start ? std::optional<State>(*start - lift) : std::nullopt;
  auto result = solved(plate, prescribed.pull(), options, again, beside ? &*beside : nullptr);
  auto& [state, iterations, residual, converged, stop_reason] = result.solution;
  state += lift;
  for (int n = 0; converged; ++n) {
    const auto left = prescribed.residual(state);
    residual = left.share;
    converged = residual <= options.tolerance;
    if (!converged && n == most)
      stop_reason = "rounding beside the forces of the supports leaves more than the tolerance";
    if (converged || n == most) break;
    auto more = options;
    more.tolerance = std::max(options.tolerance / residual / 2, 1e-9);
    const auto correction = solved(plate, left.force, more, false).solution;
    iterations += correction.iterations, converged = correction.converged, stop_reason = correction.stop_reason;
    state += correction.state;
  }
  return result;
}

/// Points that have left their support move with it as if it had moved: they bear nothing where the gap is.
StaticResult StaticSolver::pushed(const Forces& load, const StaticOptions& options, const State& lift) {
  const auto found = (*pushing_)(load, lift);
  auto result = lifted(*plate_, load, options, false, lift.cols() > 0 ? State(found.lift + lift) : found.lift);
  result.lifted = found.lifted;
  return result;
}

StaticResult StaticSolver::operator()(const Forces& load, const StaticOptions& options, bool again, const State& lift) {
  if (plate_->boundary().elastic_supports.unilateral()) return in_contact(load, options, lift);
  if (pushing_) return pushed(load, options, lift);
  if (lift.cols() == 0 && plate_->problem().elastically_supported()) {
    const auto parts = split_load(*plate_, load);
    auto result = solved(*plate_, parts.rest, options, again);
    if (parts.rigid.cols() > 0) result.solution.state += parts.rigid;
    if (parts.rigid.cols() > 0 && largest_of(*plate_, parts.rest.cwiseAbs().maxCoeff()) == 0)
      result.solution.stop_reason = "the plate moves as one rigid body";
    return result;
  }
  const auto [rigid, rest] = split_lift(*plate_, lift);
  auto result = lifted(*plate_, load, options, again, rest);
  if (rigid.cols() > 0) result.strained = result.solution.state, result.solution.state += rigid;
  return result;
}

std::optional<State> nearest(const std::vector<State>& states, const std::vector<Forces>& forces, const Forces& load,
                             const Constraints& constraints) {
  if (states.empty()) return std::nullopt;
  const auto size = Eigen::Index(states.size());
  Eigen::MatrixXd energies(size, size);
  Eigen::VectorXd work(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto& state = states[std::size_t(i)];
    work[i] = dot(constraints, state, load);
    for (Eigen::Index j = 0; j < size; ++j) energies(i, j) = -dot(constraints, state, forces[std::size_t(j)]);
  }
  const Eigen::MatrixXd symmetric = (energies + energies.transpose()) / 2;
  const Eigen::VectorXd share = symmetric.completeOrthogonalDecomposition().solve(work);
  State result = zero_like(load);
  for (Eigen::Index i = 0; i < size; ++i) result += share[i] * states[std::size_t(i)];
  return result;
}

}  // namespace plate
