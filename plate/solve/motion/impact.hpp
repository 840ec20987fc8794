#pragma once
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

/// The contact in steps.
class ImpactContact {
public:
  /// `state`: of the plate at time 0.
  ImpactContact(const Impactor& impactor, const State& state);
  /// Goes on.
  ImpactContact(const Impactor& impactor, const Striker& striker) : impactor_(impactor), striker_(striker) {}

  /// The force in this state; adds it to forces that are not folded.
  void press(const State& state, Forces& forces);
  /// At a step whose velocity is `half` a step after that of the striker: after press().
  Blow blow(double half) const;
  /// Energies: of the spring, of the mass with the velocity of the step, and with the mean of both halves.
  double spring() const;
  double kinetic(double half) const;
  double discrete_kinetic(double half, double time_step) const;
  void move(double share, double time_step);
  const Striker& striker() const { return striker_; }

private:
  double acceleration() const { return -force_ / impactor_.mass; }

  Impactor impactor_;
  Striker striker_;
  double overlap_ = 0, force_ = 0;
};

/// The stable step of a plate whose own is `free`, with the spring pressing all the time: a lower bound; and not above
/// what keeps the energy of the contact to a hundredth.
/// `mass`: folded.
double stable_step(double free, const Impactor& impactor, const Constraints& constraints, const Forces& mass);

}  // namespace plate
