#include "plate/solve/motion/contact_and_damping.hpp"

#include <algorithm>
#include <cmath>

#include "plate/formulation/constraints.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

/// Deflection at the place of impact, the same on all ranks.
double deflection(const Impactor& impactor, const State& state) {
  static const PointMap one_process;
  const PointMap& map = impactor.map ? *impactor.map : one_process;
  return ordered_sum<1>(map, impactor.terms.size(), [&](std::size_t i) {
    const auto& [dof, factor] = impactor.terms[i];
    return std::array<double, 1>{map.owns(dof.point) ? factor * at_dof(state, dof) : 0};
  })[0];
}

}  // namespace

ImpactContact::ImpactContact(const Impactor& impactor, const State& state)
    : impactor_(impactor), impactor_state_{deflection(impactor, state), impactor.velocity} {}

void ImpactContact::press(const State& state, Forces& forces) {
  const double towards = impactor_.velocity < 0 ? -1 : 1;
  overlap_ = std::max(0.0, towards * (impactor_state_.place - deflection(impactor_, state)));
  force_ = towards * impactor_.stiffness * overlap_;
  if (std::abs(force_) > std::abs(impactor_state_.largest)) impactor_state_.largest = force_;
  for (const auto& [dof, factor] : impactor_.terms) at_dof(forces, dof) += factor * force_;
}

ImpactorMotion ImpactContact::contact_force(double half) const {
  return {impactor_state_.place,
          impactor_state_.velocity + half * acceleration(),
          force_,
          impactor_state_.largest,
          impactor_state_.touching,
          impactor_.terms};
}

double ImpactContact::spring() const {
  return impactor_.stiffness * overlap_ * overlap_ / 2;
}

double ImpactContact::kinetic(double half) const {
  const double v = impactor_state_.velocity + half * acceleration();
  return impactor_.mass * v * v / 2;
}

double ImpactContact::discrete_kinetic(double half, double time_step) const {
  const double change = time_step / 2 * acceleration();
  return kinetic(half) - impactor_.mass * change * change / 2;
}

void ImpactContact::move(double share, double time_step) {
  impactor_state_.velocity += share * acceleration();
  impactor_state_.place += time_step * impactor_state_.velocity;
  if (force_ != 0) impactor_state_.touching += time_step;
}

/// Stable step with an impactor: the largest eigenvalue of a sum is at most the sum of theirs. A step on the way into
/// the contact may count too much by (dt Omega)^2 of the energy there, Omega^2 = k (1 / m + b M^-1 b): at most a
/// hundredth.
double stable_step(double free, const Impactor& impactor, const Constraints& constraints, const Forces& mass) {
  Forces unit = zero_like(mass);
  for (const auto& [dof, factor] : impactor.terms) at_dof(unit, dof) += factor;
  constraints.fold(unit);
  const auto [of_plate] = ordered_sum<1>(constraints, std::size_t(unit.size()), [&](std::size_t i) {
    const double f = unit.data()[i], m = mass.data()[i];
    return std::array<double, 1>{m > 0 ? f * f / m : 0};
  });
  constexpr double of_contact = 0.1;
  const double square = impactor.stiffness * (1 / impactor.mass + of_plate);
  return std::min(2 / std::sqrt(4 / (free * free) + square), of_contact / std::sqrt(square));
}

ContactAndDamping::ContactAndDamping(const DynamicOptions& options, const State& state)
    : damping_{options.mass_damping, options.stiffness_damping},
      time_step_(options.time_step),
      relaxation_(options.stiffness_damping > 0 ? options.relaxation : 0),
      kept_(options.save),
      faces_(options.faces, options.from ? options.from->contact : ContactMemory{}) {
  const auto* from = options.from;
  if (from) earlier_ = from->earlier, dissipated_ = from->dissipated;
  if (from && relaxation_ > 0) relaxing_ = from->relaxing, viscous_ = from->relaxing_force;
  if (options.impact)
    contact_ = from ? ImpactContact(*options.impact, from->impactor_state) : ImpactContact(*options.impact, state);
}

void ContactAndDamping::find(const State& state, const State& velocity, const Forces& force, const ForceOf& force_of) {
  if (relaxation_ > 0)
    relax(velocity, force, force_of);
  else if (damping_.stiffness > 0) {
    if (before_.size() == 0)
      before_ = earlier_.size() > 0 ? force_of(earlier_) : Forces(force - time_step_ * force_of(velocity));
    viscous_ = damping_.stiffness / time_step_ * (force - before_);
    before_ = force;
  }
  if (damping_.stiffness > 0 && kept_) earlier_ = state;
  if (contact_ || faces_.any()) pressed_.setZero(force.rows(), force.cols());
  if (contact_) contact_->press(state, pressed_);
}

void ContactAndDamping::relax(const State& velocity, const Forces& force, const ForceOf& force_of) {
  if (before_.size() == 0 && earlier_.size() > 0) before_ = force_of(earlier_);
  if (before_.size() == 0) {  // at time 0 nothing is strained yet
    relaxing_ = zero_like(velocity), viscous_ = zero_like(force), before_ = force;
    return;
  }
  const double lasts = std::exp(-time_step_ / relaxation_), comes = damping_.stiffness * (1 - lasts);
  relaxing_ = lasts * relaxing_ + comes * velocity;
  viscous_ = lasts * viscous_ + comes / time_step_ * (force - before_);
  before_ = force;
}

void ContactAndDamping::add_on_held(const Constraints& constraints, const ForceOf& force_of,
                                    Eigen::VectorXd& held) const {
  if (relaxation_ > 0)
    held += constraints.on_held(force_of(relaxing_));
  else if (viscous_.size() > 0)
    held += constraints.on_held(viscous_);
}

void ContactAndDamping::fold(const Constraints& constraints) {
  if (viscous_.size() > 0) constraints.fold(viscous_);
  if (pressed_.size() > 0) constraints.fold(pressed_);
}

void ContactAndDamping::move(double share) {
  if (contact_) contact_->move(share, time_step_);
  faces_.count();
}

void ContactAndDamping::save(MotionCheckpoint& memory) const {
  memory.earlier = earlier_, memory.dissipated = dissipated_, memory.contact = faces_.memory();
  if (relaxation_ > 0) memory.relaxing = relaxing_, memory.relaxing_force = viscous_;
  if (contact_) memory.impactor_state = contact_->impactor_state();
}

}  // namespace plate
