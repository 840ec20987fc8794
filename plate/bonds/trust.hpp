#pragma once
#include "plate/formulation/formulation.hpp"

namespace plate {

/// What of a plate of bonds over a horizon is not to be trusted: thin plates, the layer beside free edges, lattices
/// that are not isotropic, oblique edges. `factors`: intensity factors are asked for.
std::vector<std::string> distrust_of_bonds(const Formulation& plate, bool factors);

/// Those of them that a comparison with the Galerkin plate replaces by numbers: shear locking of thin plates, and
/// stress at holes and clamped edges.
std::vector<std::string> foretold_errors(const Formulation& plate);

/// Share by which deflections usually are too large where edges are oblique to the lattice: stairs of the spacing.
double error_of_stairs(const Formulation& plate);

}  // namespace plate
