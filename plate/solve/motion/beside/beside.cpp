#include "plate/solve/motion/beside/beside.hpp"

#include "plate/formulation/constraints.hpp"

namespace plate {

Beside::Beside(const DynamicOptions& options, const State& state)
    : damping_{options.mass_damping, options.stiffness_damping}, time_step_(options.time_step), kept_(options.keep) {
  const auto* from = options.from;
  if (from) earlier_ = from->earlier, dissipated_ = from->dissipated;
  if (options.impact)
    contact_ = from ? ImpactContact(*options.impact, from->striker) : ImpactContact(*options.impact, state);
}

void Beside::find(const State& state, const State& velocity, const Forces& force, const ForceOf& force_of) {
  if (damping_.stiffness > 0) {
    if (before_.size() == 0)
      before_ = earlier_.size() > 0 ? force_of(earlier_) : Forces(force - time_step_ * force_of(velocity));
    viscous_ = damping_.stiffness / time_step_ * (force - before_);
    before_ = force;
    if (kept_) earlier_ = state;
  }
  if (!contact_) return;
  pressed_.setZero(3, force.cols());
  contact_->press(state, pressed_);
}

void Beside::add_on_held(const Constraints& constraints, Eigen::VectorXd& held) const {
  if (viscous_.size() > 0) held += constraints.on_held(viscous_);
}

void Beside::fold(const Constraints& constraints) {
  if (viscous_.size() > 0) constraints.fold(viscous_);
  if (pressed_.size() > 0) constraints.fold(pressed_);
}

void Beside::move(double share) {
  if (contact_) contact_->move(share, time_step_);
}

void Beside::remember(MotionMemory& memory) const {
  memory.earlier = earlier_, memory.dissipated = dissipated_;
  if (contact_) memory.striker = contact_->striker();
}

}  // namespace plate
