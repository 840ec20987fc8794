#include "plate/solve/settled.hpp"

#include <algorithm>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/history.hpp"
#include "plate/model/nodal_forces.hpp"

namespace plate {
namespace {

/// Of forces where there is stiffness, each by the displacement that it causes; as the solvers measure.
double norm(const Forces& forces, const Forces& diagonal) {
  double sum = 0;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (const double d = diagonal.data()[i]; d > 0) sum += forces.data()[i] * forces.data()[i] / d;
  return std::sqrt(sum);
}

}  // namespace

bool settles(const Formulation& plate) {
  return std::ranges::any_of(plate.loads(), [](const TimedLoad& load) { return load.lifts(); });
}

namespace {

/// `factor` of every load.
template <typename Factor>
State sum_of_lifts(const std::vector<TimedLoad>& loads, const Factor& factor) {
  State lift(3, 0);
  for (const auto& one : loads) {
    if (!one.lifts()) continue;
    if (lift.cols() == 0) lift = State::Zero(3, one.lift.cols());
    lift += factor(one) * one.lift;
  }
  return lift;
}

}  // namespace

State total_lift(const Formulation& plate) {
  return sum_of_lifts(plate.loads(), [](const TimedLoad&) { return 1.0; });
}

State first_lift(const Formulation& plate) {
  return sum_of_lifts(plate.loads(), [](const TimedLoad& one) { return factor(one.history, 0); });
}

Forces whole_mass(const Formulation& plate, double rotary) {
  return mass(plate.sections(), plate.cloud().areas, plate.boundary().active, {}, rotary);
}

Settled::Settled(const Formulation& plate, const Forces& load, const State& lift)
    : plate_(plate), load_(load), lift_(lift) {}

Forces Settled::force(const State& state) const {
  Forces result;
  plate_.internal_force(state, result);
  return result + load_;
}

Settled::Left Settled::left(const State& state) const {
  constexpr double rounding = 1e-13;
  const auto& constraints = plate_.constraints();
  const Forces diagonal = plate_.diagonal(), whole = force(state);
  Forces folded = diagonal;
  constraints.fold_diagonal(folded);
  Forces reaction = Forces::Zero(3, whole.cols());
  for (const auto dof : constraints.held()) at_dof(reaction, dof) = at_dof(whole, dof);
  Left result{whole};
  constraints.fold(result.force);
  Forces at_first = pull();
  constraints.fold(at_first);
  const double left = norm(result.force, folded);
  const double size = std::max(norm(load_, diagonal), norm(reaction, diagonal));
  if (left > rounding * norm(at_first, folded)) result.share = left / size;
  return result;
}

double Settled::work(const State& state) const {
  if (lift_.cols() == 0) return 0;
  return -force(state).cwiseProduct(lift_).sum() / 2;
}

}  // namespace plate
