#pragma once
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"

/// Plates at rest, and what they show at places.
namespace verified_plate {

/// Equilibrium under all loads, whichever solver finds it; the test fails where none does.
inline plate::State at_rest(const plate::Formulation& plate, double tolerance = 1e-10) {
  const auto found = plate::solve_static(plate, plate.total_load(), plate::StaticMethod::cg,
                                         plate::Preconditioning::automatic, {tolerance, 20000, {}});
  REQUIRE(found.solution.converged);
  return found.solution.state;
}

/// Deflection at a place, by the interpolation of the plate [length].
inline double at(const plate::Formulation& plate, const plate::State& u, const geometry::Point& x) {
  double sum = 0;
  for (const auto& share : plate.interpolation(x)) sum += share.weight * u(0, share.point);
  return sum;
}

}  // namespace verified_plate
