#pragma once
#include <optional>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Formulation;
struct Load;
struct Problem;
struct Resultants;
struct Section;

/// Free strain that is linear over a plate in its plane: alpha times its mean temperature.
struct LinearStrain {
  double at_origin = 0;
  geometry::Point gradient{0, 0};  // [1 / length]

  double at(const geometry::Point& x) const { return at_origin + gradient.dot(x); }
  bool varies() const { return gradient != geometry::Point(0, 0); }
};

/// Thermal load of a plate at an instant (theory.md, "Heated plates"). Empty where no temperature acts: the functions
/// below then cost nothing. Of a membrane (PlateLaw::membrane) curvatures are the strains alpha T of the mean
/// temperature, and moments are membrane forces.
struct Heat {
  Eigen::VectorXd curvature = {};           // kappa_0 of the points of the plate [1 / length], of a membrane alpha T
  Forces forces = {};                       // what it loads the plate with [3 x points]
  std::optional<LinearStrain> linear = {};  // of a membrane, where all strains are the same everywhere or linear
  Eigen::VectorXd beside = {};  // where the section couples: of a plate the free strain, of a membrane the curvature

  bool none() const { return curvature.size() == 0; }
};

/// The strain of a mean temperature that is the same everywhere or linear, seen at places all over the box about the
/// plate: its field is free of stress, and a plate whose points lie on its edges takes it so. None of other loads, of a
/// plate that bends, whose linear curvature is not free of stress, and beside beams, which stay cold.
std::optional<LinearStrain> linear_strain(const Problem& problem, const Load& load);

/// Thermal load of the loads times `shares`.
Heat heat_of(const Formulation& plate, const std::vector<double>& shares);
/// Thermal load of the loads as they are at a time; in statics of the full loads.
Heat heat_at(const Formulation& plate, double time);
/// Thermal load of all loads times one share.
Heat heat_of(const Formulation& plate, double share);

/// Moments Mxx, Myy, Mxy per free curvature kappa_0 of a plate that is held flat: D (1 + nu) (1, 1, 0), or with
/// directions the bending stiffness times (1, 1, 0), or by strains of the plies (held_plies()) [force length].
Eigen::Vector3d moments_held_flat(const Section& section);

/// Moments, or of a membrane forces, Mxx, Myy, Mxy of every point by the heat of a plate that may not strain [3 x
/// points].
Eigen::Matrix3Xd held_forces(const Section& section, const Heat& heat);

/// Excess of the energy of a heated plate, that of kappa - kappa_0, over that of kappa [force length]. The work of the
/// loads, heat input included, is greater by the same amount. The excess is the energy of the plate held flat, the sum
/// of A (kappa_0, kappa_0) M / 2 (isotropic A D (1 + nu) kappa_0^2), less the work of the thermal forces. Where the
/// section couples, that of a plate and that of its plane make the whole. Collective: every rank that shares the plate
/// must call it.
double stored(const Formulation& plate, const Heat& heat, const State& state);

/// Takes the moments moments_held_flat() kappa_0 that free curvature would have away.
void relieve(Resultants& resultants, const Section& section, const Heat& heat);

/// The field that a plate in its plane takes freely under a linear strain, which moves and turns nothing at a place.
State free_field(const std::vector<geometry::Point>& positions, const geometry::Point& place,
                 const LinearStrain& strain);
/// Free field that moves nothing at the lower left corner of the box about the plate.
State free_field(const std::vector<geometry::Point>& positions, const Problem& problem, const LinearStrain& strain);

/// A state less the curvature that the plate would take freely under the heat at a place: w = -kappa_0 r^2 / 2 about
/// it, psi = grad w. Its moments next to the place are those of kappa - kappa_0.
State cold(const State& state, const std::vector<geometry::Point>& positions, const geometry::Point& place,
           double curvature);

}  // namespace plate
