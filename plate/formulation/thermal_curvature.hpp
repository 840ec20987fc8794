#pragma once
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/state.hpp"

namespace plate {

class Formulation;
struct Resultants;
struct Section;

/// What temperatures do to a plate at an instant (theory.md, "Heated plates"). Empty where none acts: nothing below
/// costs anything then.
struct Heat {
  Eigen::VectorXd curvature = {};  // kappa_0 of the points of the plate [1 / length]
  Forces forces = {};              // what it loads the plate with [3 x points]

  bool none() const { return curvature.size() == 0; }
};

/// Of loads times `shares`.
Heat heat_of(const Formulation& plate, const std::vector<double>& shares);
/// Of loads as they are at a time; in statics the whole.
Heat heat_at(const Formulation& plate, double time);
/// Of all loads times one share.
Heat heat_of(const Formulation& plate, double share);

/// Moments Mxx, Myy, Mxy per free curvature kappa_0 of a plate that is held flat: D (1 + nu) (1, 1, 0), or with
/// directions the bending stiffness times (1, 1, 0) [force length].
Eigen::Vector3d moments_held_flat(const Section& section);

/// What the energy of a heated plate, that of kappa - kappa_0, is more than that of kappa; the work of the loads, with
/// what the heat puts in, is more by the same [force length]: the energy of the plate held flat, which is the sum of
/// A (kappa_0, kappa_0) M / 2 (isotropic A D (1 + nu) kappa_0^2), less what the forces do. Processes that share the
/// plate call it at once.
double stored(const Formulation& plate, const Heat& heat, const State& state);

/// Takes the moments moments_held_flat() kappa_0 that free curvature would have away.
void relieve(Resultants& resultants, const Section& section, const Heat& heat);

/// A state less the curvature that the plate would take freely under the heat at a place: w = -kappa_0 r^2 / 2 about
/// it, psi = grad w. Its moments next to the place are those of kappa - kappa_0.
State cold(const State& state, const std::vector<geometry::Point>& positions, const geometry::Point& place,
           double curvature);

}  // namespace plate
