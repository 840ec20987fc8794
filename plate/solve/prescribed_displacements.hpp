#pragma once
#include <vector>
#include "plate/model/state.hpp"

namespace plate {

class Formulation;
class Operator;

/// True where settlements prescribe displacements.
bool has_prescribed_displacements(const Formulation& plate);
/// Dirichlet lift of all settlements: at their last values together, at a time, and at time 0; without columns where
/// there are none.
State total_lift(const Formulation& plate);
State lift_at(const Formulation& plate, double time);
State first_lift(const Formulation& plate);
/// Mass per degree of freedom before constraints are applied. `rotary`: factor of the rotary
/// inertia.
Forces unconstrained_mass(const Formulation& plate, double rotary = 1);

/// True where loads that act together cancel, to rounding, wherever the plate may move. False for one load alone.
bool cancel(const Formulation& plate, const std::vector<Forces>& loads);
/// Sum of all loads at their last values; zero where they cancel.
Forces acting_load(const Formulation& plate);

/// Two parts of the Dirichlet lift of settlements.
struct LiftParts {
  State rigid;  // a motion of the whole plate as one rigid body, which strains nothing; without columns: none
  State rest;   // the lift beside it; exactly zero where all supports move as that body
};
/// `lift`: as total_lift(). The body is the one next to what is held, so that rounding of the stiffness is that of the
/// smaller motion. Nothing is taken out of plates on foundations and springs, which resist it. Collective.
LiftParts split_lift(const Formulation& plate, const State& lift);

/// Two parts of what a load does to a plate that nothing but foundations and springs holds.
struct LoadParts {
  State rigid;  // the plate as one rigid body in equilibrium; without columns where something holds it
  Forces rest;  // the load and what foundations and springs press on that body: in equilibrium with each other, or zero
};
/// By these the deflections of a plate on soft springs, which are far larger than what strains it, have all digits.
/// Collective.
LoadParts split_load(const Formulation& plate, const Forces& load);

/// A plate at rest whose supports have moved. What is held is put where it is, all that is free rests: that state pulls
/// at the free points with far larger forces than those of the equilibrium, by which the residual is to be measured
/// (theory.md, "Supports that move").
class PrescribedDisplacements {
public:
  /// `load`: that acts beside; not carried over. All must outlive this. A `lift` without columns: none. `stiffness`: in
  /// place of the plate's own, as with given contact; null: that.
  PrescribedDisplacements(const Formulation& plate, const Forces& load, const State& lift,
                          const Operator* stiffness = nullptr);

  /// Load and internal force of a state.
  Forces force(const State& state) const;
  /// Forces on the plate with all free degrees of freedom at rest.
  Forces pull() const { return lift_.cols() > 0 ? force(lift_) : load_; }

  struct Residual {
    Forces force;      // carried over to the free degrees of freedom
    double share = 0;  // of it, of the larger one of loads and reactions; 0 where only rounding is left
  };
  Residual residual(const State& state) const;

  /// Work of the supports that have moved slowly [energy].
  double work(const State& state) const;

private:
  const Formulation& plate_;
  const Operator& stiffness_;
  const Forces& load_;
  const State& lift_;
};

}  // namespace plate
