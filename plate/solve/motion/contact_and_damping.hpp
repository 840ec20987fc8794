#pragma once
#include <functional>
#include <optional>

#include "plate/model/numerical_method.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace plate {

class Constraints;

/// The contact in steps.
class ImpactContact {
public:
  /// `state`: of the plate at time 0.
  ImpactContact(const Impactor& impactor, const State& state);
  /// Continues from the state of an impactor.
  ImpactContact(const Impactor& impactor, const ImpactorState& impactor_state)
      : impactor_(impactor), impactor_state_(impactor_state) {}

  /// The force in this state; adds it to forces that are not folded.
  void press(const State& state, Forces& forces);
  /// Contact force at a step whose velocity is `half` a step after that of the impactor. Requires press().
  ImpactorMotion contact_force(double half) const;
  /// Energies: of the spring, of the mass with the velocity of the step, and with the mean of both halves.
  double spring() const;
  double kinetic(double half) const;
  double discrete_kinetic(double half, double time_step) const;
  void move(double share, double time_step);
  const ImpactorState& impactor_state() const { return impactor_state_; }

private:
  double acceleration() const { return -force_ / impactor_.mass; }

  Impactor impactor_;
  ImpactorState impactor_state_;
  double overlap_ = 0, force_ = 0;
};

/// The stable step of a plate whose own is `free`, with the spring pressing all the time: a lower bound; and not above
/// what keeps the energy of the contact to a hundredth.
/// `mass`: folded.
double stable_step(double free, const Impactor& impactor, const Constraints& constraints, const Forces& mass);

/// Forces in time steps beside loads and stiffness: damping, of the mass with the mean velocity of both halves of a
/// step, of the stiffness with that of the half step before, and the contact with a mass (theory (84, 85)), and that of
/// the faces of cracks.
class ContactAndDamping {
public:
  /// Internal forces of a state in which what is held need not follow yet; not folded.
  using ForceOf = std::function<Forces(State)>;

  ContactAndDamping(const DynamicOptions& options, const State& state);

  bool acts() const { return contact_ || damps() || faces_.any(); }
  bool damps() const { return !damping_.none(); }
  const Damping& damping() const { return damping_; }
  const std::optional<ImpactContact>& contact() const { return contact_; }
  const MovingFaces& faces() const { return faces_; }
  /// Force of stiffness-proportional damping alone, and its sum with the contact force; folded after fold().
  double viscous(Eigen::Index i) const { return viscous_.size() > 0 ? viscous_.data()[i] : 0; }
  double force(Eigen::Index i) const { return viscous(i) + (pressed_.size() > 0 ? pressed_.data()[i] : 0); }
  double dissipated() const { return dissipated_; }
  /// By what damping strains the plate beside the state, on free degrees of freedom, and a factor. `velocity`: as in
  /// find().
  std::pair<State, double> strains_by(const State& velocity) const {
    return relaxation_ > 0 ? std::pair(relaxing_, 1.0) : std::pair(velocity, damping_.stiffness);
  }

  /// `force`: internal, not folded; `velocity`: half a step before, at step 0 that of time 0.
  void find(const State& state, const State& velocity, const Forces& force, const ForceOf& force_of);
  void add_on_held(const Constraints& constraints, const ForceOf& force_of, Eigen::VectorXd& held) const;
  void fold(const Constraints& constraints);
  /// Finds the forces between faces of cracks under all others, and adds them to the folded ones.
  void press_faces(const MovingFaces::FreeStep& step) { faces_.press(step, pressed_); }
  void lose(double energy) { dissipated_ += energy; }
  void move(double share);
  void save(MotionCheckpoint& memory) const;

private:
  /// The damping force in a step that relaxes: q = r q + beta (1 - r) / dt (change of the force) (theory (84a)).
  void relax(const State& velocity, const Forces& force, const ForceOf& force_of);

  Damping damping_;
  double time_step_, relaxation_;
  bool kept_;  // true where its state is to be saved
  std::optional<ImpactContact> contact_;
  MovingFaces faces_;
  State earlier_;   // of the step before
  State relaxing_;  // where the force relaxes: by what it strains the plate
  Forces before_, viscous_, pressed_;
  double dissipated_ = 0;
};

}  // namespace plate
