#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/operator.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/crack_contact.hpp"
#include "plate/solve/matrices/point_matrix.hpp"
#include "plate/solve/motion/moving_faces.hpp"
#include "plate/solve/stretching.hpp"

namespace plate {

struct Analysis;

/// A plate and the same points in their plane (PlateLaw::membrane) that move by central differences. All states, forces
/// and masses are stacked() [3 x 2 points]. Where the middle plane stretches (Problem::stretches) the plate has von
/// Karman's strains, and its forces are not linear in the state; else neither part acts on the other but where the
/// plate is coupled (theory.md, "Coupled sections").
class StretchedMotion : public Operator {
public:
  /// Stiffness of a plate and its plane while their cracks grow.
  struct Growing {
    const Operator &plate, &membrane;
  };

  /// All must outlive this. `rotary`: factor of the rotary inertia; `growing`: in place of the stiffness of both, of a
  /// plate whose plane does not stretch.
  StretchedMotion(const Formulation& plate, const Formulation& membrane, double rotary,
                  std::optional<Growing> growing = {});
  ~StretchedMotion() override;

  std::size_t points() const override;
  void internal_force(const State& state, Forces& forces) const override;
  /// Bounds |K| state of the linear part.
  void absolute_product(const State& state, Forces& forces) const override;
  /// Diagonal of the linear part.
  Forces diagonal() const override;

  const Constraints& constraints() const { return constraints_; }
  /// Mass of every degree of freedom, carried over to the free ones or not. u and v have that of w.
  Forces mass() const;
  const Forces& unconstrained_mass() const { return unconstrained_mass_; }
  /// True of points that the rank owns, of the plate and in its plane [2 x points]; empty: all.
  std::vector<char> owned() const;
  std::vector<TimedLoad> loads() const;
  /// Loads in the plane at a time [3 x points].
  Forces load_in_plane(double time) const;
  /// Strain energy of the plane, with that of the deflections where they stretch it, and of the coupling.
  double energy_in_plane(const State& state) const;
  double coupling_energy(const State& state) const;  // of kappa . B epsilon alone, of either sign
  double strain_energy(const State& state) const;

  /// Pairs of points on the faces of cracks that may touch; none where they may overlap.
  const MovingPairs& faces() const { return faces_; }
  /// Contact of these pairs, whose changes of the states stay empty.
  TouchingFaces touching(const std::vector<PairContact>& contacts) const;

  /// State of rest under the loads of time 0, of a plate whose plane does not stretch; nothing where these are none.
  /// @throws NumericalError  where there is no equilibrium
  State at_rest(const Analysis& analysis) const;
  /// State with given deflections: u and v are in equilibrium with them.
  State deflected(const State& bending) const;

  /// True where the plate acts on its plane, and the plane on the plate.
  bool act_on_each_other() const { return stretching_ || linear_; }
  /// Forces of the plane on the plate, and of given deflections and rotations on the plane with the strains of it. Of
  /// parts that act on each other.
  Forces on_bending(const State& state) const;
  Stretch stretch(const State& bending) const;
  /// The middle plane where it stretches, else null.
  const Stretching* stretching() const { return stretching_.get(); }

private:
  const Formulation& plate_;
  const Formulation& membrane_;
  std::optional<Growing> growing_;
  PointMatrix coupling_;                    // without points where bending and stretching are not coupled
  std::unique_ptr<const Operator> linear_;  // the stiffness where they are
  Constraints constraints_;
  Forces unconstrained_mass_;
  std::unique_ptr<const Stretching> stretching_;
  std::optional<FaceRows> rows_;  // where faces may touch
  MovingPairs faces_;
};

/// Stable time step of a plate and its plane. `rotary`: factor of the rotary inertia. Where the middle plane stretches,
/// 0.9 of that at rest: slopes of 0.3, to which von Karman's strains hold, raise the largest frequency by up to 10 %.
double stable_time_step(const Formulation& plate, const Formulation& membrane, double rotary);

/// Half the work that a state of a plate does against the forces of a stiffness of its points, over all ranks.
double half_work(const Formulation& plate, const Operator& stiffness, const State& state);

}  // namespace plate
