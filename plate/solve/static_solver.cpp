#include "plate/solve/static_solver.hpp"

#include <fmt/format.h>

#include <Eigen/QR>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/reduction.hpp"
#include "plate/solve/settled.hpp"
#include "plate/solve/touched_plate.hpp"

namespace plate {

namespace {

/// Over all processes that share the plate.
double product(const State& a, const Forces& b) {
  return ordered_sum<1>(std::size_t(a.size()),
                        [&](std::size_t i) { return std::array<double, 1>{a.data()[i] * b.data()[i]}; })[0];
}

}  // namespace

StaticSolver::StaticSolver(const Formulation& plate, StaticMethod method, Preconditioning wanted)
    : plate_(&plate), method_(method) {
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
  const auto near = start ? std::optional(*start) : nearest(states_, forces_, folded);
  StaticResult result{conjugate_gradients(plate, constraints, load, options, inverse_.get(), near ? &*near : nullptr),
                      "cg", name_, bytes};
  if (again && states_.size() < most) {
    states_.push_back(result.solution.state);
    plate.internal_force(states_.back(), forces_.emplace_back());
    constraints.fold(forces_.back());
  }
  return result;
}

namespace {

constexpr auto flies = "nothing holds the plate any more where its soil lets it lift off: it tips or flies off";

/// A plate that flies off goes so far that rounding hides what is left of its load.
void require_sound(const Formulation& plate, const Forces& load, const State& state) {
  constexpr double left = 1e-3;  // of the load
  const State rests(3, 0);
  if (Settled(plate, load, rests).left(state).share > left) throw NumericalError(flies);
}

/// Does soil touch at the same places, of whichever process?
bool same_everywhere(const Formulation& plate, const Touching& one, const Touching& other) {
  bool differ = false;
  const auto& parts = plate.boundary().attached.parts();
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t p = 0; p < one[i].size(); ++p)
      if (one[i][p] != other[i][p] && plate.boundary().owns(parts[i]->contact->point(p, plate.points()))) differ = true;
  return largest_of_all(differ) == 0;
}

/// Of a load that is not carried over.
double potential(const Formulation& plate, const Forces& load, const State& state) {
  if (!ranks()) return -load.cwiseProduct(state).sum();
  return -ordered_sum<1>(plate.points(), [&](std::size_t k) {
    const auto i = Eigen::Index(k);
    return std::array<double, 1>{plate.boundary().owns(k) ? load.col(i).dot(state.col(i)) : 0};
  })[0];
}

}  // namespace

/// The energy is convex and has a continuous slope: a step of Newton that does not lower it is halved until it does.
StaticResult StaticSolver::in_contact(const Forces& load, const StaticOptions& options) {
  constexpr int most = 60, halvings = 12;
  const auto& attached = plate_->boundary().attached;
  const auto energy = [&](const State& now) { return plate_->strain_energy(now) + potential(*plate_, load, now); };
  StaticResult result;
  std::size_t iterations = 0;
  auto touching = everywhere(attached);
  State state;
  for (int n = 0;; ++n) {
    const TouchedPlate plate(*plate_, attached, touching);
    try {
      result = solved(plate, load, options, false, n == 0 ? nullptr : &state);
    } catch (const NotPositive&) {
      throw NumericalError(flies);
    }
    auto& solution = result.solution;
    iterations += solution.iterations;
    solution.iterations = iterations;
    if (!solution.converged) {
      solution.stop_reason += fmt::format(", in step {} of the search for what soil touches", n + 1);
      return result;
    }
    auto now = attached.touching(solution.state);
    if (same_everywhere(*plate_, now, touching)) {
      require_sound(*plate_, load, solution.state);
      solution.stop_reason += fmt::format(", what soil touches found in {} steps", n + 1);
      return result;
    }
    if (n == most) {
      solution.converged = false;
      solution.stop_reason = fmt::format("what soil touches still changes after {} steps", most);
      return result;
    }
    if (n > 0) {
      const State step = solution.state - state;
      const double before = energy(state);
      double share = 1;
      for (int i = 0; i < halvings && energy(state + share * step) > before; ++i) share /= 2;
      if (share < 1) now = attached.touching(solution.state = state + share * step);
    }
    touching = std::move(now), state = std::move(solution.state);
  }
}

StaticResult StaticSolver::operator()(const Forces& load, const StaticOptions& options, bool again, const State& lift) {
  if (plate_->boundary().attached.lifts_off()) return in_contact(load, options);
  if (lift.cols() == 0) return solved(*plate_, load, options, again);
  constexpr int most = 4;
  const auto [rigid, rest] = parted(*plate_, lift);
  const Settled settled(*plate_, load, rest);
  auto result = solved(*plate_, settled.pull(), options, again);
  auto& [state, iterations, residual, converged, stop_reason] = result.solution;
  state += rest;
  for (int n = 0; converged; ++n) {
    const auto left = settled.left(state);
    residual = left.share;
    converged = residual <= options.tolerance;
    if (converged || n == most) break;
    auto more = options;
    more.tolerance = std::max(options.tolerance / residual / 2, 1e-9);
    const auto correction = solved(*plate_, left.force, more, false).solution;
    iterations += correction.iterations, converged = correction.converged, stop_reason = correction.stop_reason;
    state += correction.state;
  }
  if (rigid.cols() > 0) result.strained = state, state += rigid;
  return result;
}

std::optional<State> nearest(const std::vector<State>& states, const std::vector<Forces>& forces, const Forces& load) {
  if (states.empty()) return std::nullopt;
  const auto size = Eigen::Index(states.size());
  Eigen::MatrixXd energies(size, size);
  Eigen::VectorXd work(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto& state = states[std::size_t(i)];
    work[i] = product(state, load);
    for (Eigen::Index j = 0; j < size; ++j) energies(i, j) = -product(state, forces[std::size_t(j)]);
  }
  const Eigen::MatrixXd symmetric = (energies + energies.transpose()) / 2;
  const Eigen::VectorXd share = symmetric.completeOrthogonalDecomposition().solve(work);
  State result = State::Zero(3, load.cols());
  for (Eigen::Index i = 0; i < size; ++i) result += share[i] * states[std::size_t(i)];
  return result;
}

}  // namespace plate
