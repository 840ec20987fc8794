#include "plate/solve/settled.hpp"

#include <algorithm>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/history.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/reduction.hpp"

namespace plate {
namespace {

/// Is an entry of values [3 x points] of a point that no other process has?
bool owns(const Formulation& plate, std::size_t entry) {
  return plate.boundary().owns(entry % plate.points());
}

/// Of forces where there is stiffness, each by the displacement that it causes; as the solvers measure.
double norm(const Formulation& plate, const Forces& forces, const Forces& diagonal) {
  if (ranks()) {
    const auto of_dof = [&](std::size_t i) {
      const double f = forces.data()[i], d = diagonal.data()[i];
      return std::array<double, 1>{d > 0 && owns(plate, i) ? f * f / d : 0};
    };
    return std::sqrt(ordered_sum<1>(std::size_t(forces.size()), of_dof)[0]);
  }
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

State lift_at(const Formulation& plate, double time) {
  return sum_of_lifts(plate.loads(), [time](const TimedLoad& one) { return factor(one.history, time); });
}

State first_lift(const Formulation& plate) {
  return lift_at(plate, 0);
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
  const double left = norm(plate_, result.force, folded);
  const double size = std::max(norm(plate_, load_, diagonal), norm(plate_, reaction, diagonal));
  if (left > rounding * norm(plate_, at_first, folded)) result.share = left / size;
  return result;
}

double Settled::work(const State& state) const {
  if (lift_.cols() == 0) return 0;
  const Forces whole = force(state);
  if (!ranks()) return -whole.cwiseProduct(lift_).sum() / 2;
  const auto of_dof = [&](std::size_t i) {
    return std::array<double, 1>{owns(plate_, i) ? whole.data()[i] * lift_.data()[i] : 0};
  };
  return -ordered_sum<1>(std::size_t(whole.size()), of_dof)[0] / 2;
}

}  // namespace plate
