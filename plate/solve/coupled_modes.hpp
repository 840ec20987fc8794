#pragma once
#include <vector>

#include "plate/formulation/inertia.hpp"
#include "plate/solve/buckling.hpp"
#include "plate/solve/coupled_plate.hpp"
#include "plate/solve/motion/frequencies.hpp"

namespace plate {

/// A plate whose bending and stretching are coupled, at rest under its loads in the plane, which bend it too, and heat.
struct CoupledPrestress {
  CoupledEquilibrium at_rest;
  PointMatrix geometric;  // stiffness of the deflections by its membrane forces and those of stiffeners
};

/// Solves for the prestress. The membrane forces are those of linear theory.
/// @throws NumericalError  where it is not in equilibrium
CoupledPrestress coupled_prestress(const Formulation& plate, const Formulation& membrane);

/// The lowest frequencies and shapes of a plate whose bending and stretching are coupled (theory.md, "Coupled
/// sections"). Rigid motions in the plane that no support prevents are left out. `rotary`: factor of the rotary
/// inertia; `geometric`: by the loads in the plane, null without any. Of `options` modes, tolerance and shift count.
/// @throws NumericalError  where the iteration does not converge, or the plate buckles below the loads
FrequencySolution coupled_frequencies(const Formulation& plate, const Formulation& membrane, double rotary,
                                      const PointMatrix* geometric, const FrequencyOptions& options);

/// Mass of stacked states of a plate and of its plane, lumped. `constraints`: of stacked states; must outlive it.
Inertia coupled_inertia(const Formulation& plate, double rotary, const Constraints& constraints);

/// The lowest positive factors at which it buckles under membrane forces, as buckling().
/// @throws NumericalError  where the iteration does not converge
std::vector<BucklingMode> coupled_buckling(const Formulation& plate, const Formulation& membrane,
                                           const PointMatrix& geometric, std::size_t modes, double tolerance);

}  // namespace plate
