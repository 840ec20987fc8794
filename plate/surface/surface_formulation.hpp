#pragma once
#include "plate/model/formulation_kind.hpp"

namespace plate {

/// Bonds of the ordinary state-based plate with surface nodes on its edges: rectangles without cracks, at rest, solved
/// directly, as the stiffness is not symmetric.
extern const FormulationKind bonds_with_surface_nodes;

}  // namespace plate
