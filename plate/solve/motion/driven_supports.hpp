#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "plate/model/history.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Constraints;
struct Instant;
struct TimedLoad;

/// Held degrees of freedom in a motion by time steps whose settlements move them: their displacement, the forces that
/// their mass adds, and the work of the supports (theory.md, "Supports that move"). Without settlements it holds
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
  /// Takes the internal force in hand, and adds the inertia of what is held to it, before it is carried over.
  /// `contact`: force of a mass that presses on the plate, without columns where none does.
  template <typename Real>
  void take(Values<Real>& force, const Forces& contact);
  /// Adds, after that, the work of the supports up to now. `half`: step from the velocity to that of now; `contact`:
  /// folded.
  template <typename Real>
  void add_work(const State& state, const State& velocity, const Values<Real>& folded, const Forces& contact,
                double half);

  double work() const { return work_; }
  /// Adds the contributions of the held degrees of freedom to kinetic energies, strain energy, velocities and
  /// accelerations, which those of the free ones leave out, and the work of the supports to the external work.
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
    double force = 0, contact = 0;  // internal, of the mass that presses
  };
  double place_of(const Driven& one, double time) const;
  template <std::size_t N, typename Terms>
  std::array<double, N> sum(const Terms& terms) const;

  const Constraints* constraints_ = nullptr;
  bool any_ = false;
  std::vector<History> histories_;
  std::vector<Leader> leaders_;
  std::vector<Driven> driven_;
  double time_ = 0, dt_ = 0, work_ = 0;
  double ahead_ = 0;  // work of the reactions of the call before on the way until now
  bool counted_ = false, slow_ = false;
};

}  // namespace plate
