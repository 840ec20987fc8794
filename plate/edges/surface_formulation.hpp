#pragma once
#include "plate/model/numerical_method.hpp"

namespace plate {

/// Bonds of the ordinary state-based plate with surface nodes on its edges: edges along the axes, those of holes too,
/// with cracks that stay a horizon away from them, at rest, solved directly, as the stiffness is not symmetric.
extern const FormulationKind bonds_with_surface_nodes;

/// Bonds with surface nodes, with fictitious nodes beyond the edges that follow the points of the plate, and with
/// multipliers for the conditions at edges.
extern const FormulationKind bonds_with_fictitious_nodes;

}  // namespace plate
