#include "plate/solve/static_solver.hpp"

#include <Eigen/QR>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/reduction.hpp"

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

StaticResult StaticSolver::operator()(const Forces& load, const StaticOptions& options, bool again) {
  constexpr std::size_t most = 24;  // of what is kept
  const auto& constraints = plate_->constraints();
  const std::size_t bytes = inverse_ ? inverse_->bytes() : 0;
  if (method_ == StaticMethod::adr) {
    auto from = options;
    from.start_of_bound = start_by_place(*plate_);
    return {adaptive_dynamic_relaxation(*plate_, constraints, load, from), "adr", {}, 0};
  }
  if (method_ == StaticMethod::direct) {
    const auto solution = plate_->offers(Feature::symmetry)
                              ? conjugate_gradients(*plate_, constraints, load, options, inverse_.get())
                              : refined(*plate_, constraints, load, options, *inverse_);
    return {solution, "direct", {}, bytes};
  }
  Forces folded = load;
  constraints.fold(folded);
  const auto start = nearest(states_, forces_, folded);
  StaticResult result{
      conjugate_gradients(*plate_, constraints, load, options, inverse_.get(), start ? &*start : nullptr), "cg", name_,
      bytes};
  if (again && states_.size() < most) {
    states_.push_back(result.solution.state);
    plate_->internal_force(states_.back(), forces_.emplace_back());
    constraints.fold(forces_.back());
  }
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
