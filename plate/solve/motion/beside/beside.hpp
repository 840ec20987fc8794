#pragma once
#include <functional>
#include <optional>

#include "plate/model/solver_choices.hpp"
#include "plate/solve/motion/impact.hpp"

namespace plate {

class Constraints;

/// What acts in steps beside loads and stiffness: damping, of the mass with the mean velocity of both halves of a step,
/// of the stiffness with that of the half before, and the contact with a mass (theory (84, 85)).
class Beside {
public:
  /// Internal forces of a state in which what is held need not follow yet; not folded.
  using ForceOf = std::function<Forces(State)>;

  Beside(const DynamicOptions& options, const State& state);

  bool acts() const { return contact_ || damps(); }
  bool damps() const { return !damping_.none(); }
  const Damping& damping() const { return damping_; }
  const std::optional<ImpactContact>& contact() const { return contact_; }
  /// Of damping by the stiffness alone, and with the contact; folded.
  double viscous(Eigen::Index i) const { return viscous_.size() > 0 ? viscous_.data()[i] : 0; }
  double force(Eigen::Index i) const { return viscous(i) + (pressed_.size() > 0 ? pressed_.data()[i] : 0); }
  double dissipated() const { return dissipated_; }

  /// `force`: internal, not folded; `velocity`: half a step before, at step 0 that of time 0.
  void find(const State& state, const State& velocity, const Forces& force, const ForceOf& force_of);
  void add_on_held(const Constraints& constraints, Eigen::VectorXd& held) const;
  void fold(const Constraints& constraints);
  void lose(double energy) { dissipated_ += energy; }
  void move(double share);
  void remember(MotionMemory& memory) const;

private:
  Damping damping_;
  double time_step_;
  bool kept_;  // is what it remembers asked for?
  std::optional<ImpactContact> contact_;
  State earlier_;  // of the step before
  Forces before_, viscous_, pressed_;
  double dissipated_ = 0;
};

}  // namespace plate
