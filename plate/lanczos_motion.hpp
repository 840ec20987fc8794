#pragma once
#include "plate/dynamics.hpp"
#include "plate/inertia.hpp"
#include "plate/preconditioner.hpp"

namespace plate {

struct LanczosOptions {
  double duration = 0;
  std::size_t rows = 0;              // equal times up to the duration at which the motion is seen, and time 0
  double tolerance = 3e-4;           // of the motion: root of the mean square over the mass, relative to the largest
  std::size_t max_vectors = 800;
  bool from_equilibrium = false;     // at time 0 at rest under the loads of that time, which have grown slowly; else undeformed
  std::function<void(std::size_t vectors, double change)> progress = {};
};

struct LanczosMotion {
  std::size_t vectors = 0;
  double change = 0;                 // by the last eight vectors, in the measure of the tolerance
  double largest_frequency = 0;      // that the vectors hold [1/time]
};

/// The linear motion of a held plate in the space of load-dependent Lanczos vectors K^-1 F, (K^-1 M) K^-1 F, ... (Wilson, Yuan
/// and Dickens 1982; Nour-Omid and Clough 1984; theory.md, "Dynamics"), in which every mode moves exactly; there is no time step. Every free degree of freedom must have mass.
/// `inverse`: of K, exact or near. Histories are straight between their points, a sine between 500 points a period.
/// Calls `observe` as central_differences does, with the number of the row as its step.
/// Throws NumericalError where the vectors do not suffice or a number is not finite.
LanczosMotion lanczos_motion(const Operator& plate, const Constraints& constraints, const Inertia& inertia,
                             const std::vector<TimedLoad>& loads, const Preconditioner& inverse, const LanczosOptions& options,
                             const std::function<void(const Instant&)>& observe);

}  // namespace plate
