#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "plate/model/history.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Constraints;
class ContactAndDamping;
struct Instant;
struct Step;
struct TimedLoad;

/// Held degrees of freedom in a motion by time steps whose settlements move them: their displacement, the forces that
/// their mass and its damping add, the work of the supports, and what damping takes of it (theory.md, "Supports that
/// move"). Without settlements it holds
/// nothing and does nothing. On a distributed plate, each rank adds the terms of a held degree of freedom alone where
/// it owns that, and its terms with a leader where it owns the leader: the sums are the same on all ranks.
class DrivenSupports {
public:
  DrivenSupports() = default;
  /// `mass`: of every degree of freedom, held or not; `folded`: carried over to the free ones; `own`: owned points,
  /// empty: all. `constraints` must outlive this.
  DrivenSupports(const std::vector<TimedLoad>& loads, const Constraints& constraints, const Forces& mass,
                 const Forces& folded, const std::vector<char>& own = {});

  bool any() const { return any_; }

  /// The step that begins: where it is now, and before and after.
  void at(double time, double time_step, bool first);
  /// Adds to a state that follows from what is free where it is after the step.
  void place_next(State& state) const;
  /// Adds to a state where the supports are at `time`.
  void place(State& state, double time) const;
  /// Subtracts from a state where the supports are now: the rest is what loads work on.
  void leave_out(State& state) const;
  /// Takes the internal force in hand, and adds the inertia of what is held, and the drag on it, before it is carried
  /// over. `beside`: contact and damping, not folded yet.
  template <typename Real>
  void take(Values<Real>& force, const ContactAndDamping& beside);
  /// Adds, after that, the work of the supports up to now and what damping has taken. `beside`: folded.
  template <typename Real>
  void add_work(const Step& step, const Values<Real>& folded, const ContactAndDamping& beside);

  double work() const { return work_; }
  /// Adds the contributions of the held degrees of freedom to kinetic energies, strain energy, dissipated energy,
  /// velocities and accelerations, which those of the free ones leave out, and the work of the supports to the external
  /// work.
  void complete(Instant& seen) const;

  /// The numbers to go on from.
  std::vector<double> memory() const;
  void restore(const std::vector<double>& memory);
  /// The plate has come to where it is at time 0 slowly.
  void start();

private:
  struct Leader {
    Dof dof;
    bool own;
    double inverse_mass, acceleration = 0, velocity = 0;
    double since = 0, ahead = 0;     // what it moves by in the steps before and after
    std::vector<double> loads = {};  // folded, of every load at factor 1
  };
  struct Driven {
    Dof dof;
    bool own;
    double mass;
    std::vector<double> lifts;                                 // of every load
    std::vector<std::pair<std::size_t, double>> leaders = {};  // with factors
    double before = 0, now = 0, next = 0;                      // where it is
    double speed = 0, acceleration = 0;                        // its own, beside what it follows
    double follows_at = 0;
    double force = 0, beside = 0;  // internal; of damping by the stiffness and the mass that presses
    double inertia = 0, drag = 0;  // with the drag on its mass; all damping of its own [force]
    double strained = 0;           // by which damping by the stiffness strains it (Instant::strained)
  };
  double place_of(const Driven& one, double time) const;
  void add_losses(double mass_damping);
  template <std::size_t N, typename Terms>
  std::array<double, N> sum(const Terms& terms) const;

  const Constraints* constraints_ = nullptr;
  bool any_ = false;
  std::vector<History> histories_;
  std::vector<Leader> leaders_;
  std::vector<Driven> driven_;
  double time_ = 0, dt_ = 0, work_ = 0;
  double ahead_ = 0;                        // work of the reactions of the call before on the way until now
  double dissipated_ = 0, lost_ahead_ = 0;  // by damping, beside what that of the free ones takes [energy]
  bool counted_ = false, slow_ = false;
};

}  // namespace plate
