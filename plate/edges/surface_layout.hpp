#pragma once
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/edges/surface_plate.hpp"
#include "plate/formulation/layout.hpp"
#include "plate/model/problem.hpp"

namespace plate {

/// Checks that surface nodes or fictitious nodes can serve these edges, cracks and points.
/// @throws Refused  with fictitious nodes edges that are not along the axes, else those shorter than half a spacing;
/// holes and notches narrower than two horizons, edges shorter than one; cracks as near to an edge as a horizon;
/// horizons wide for the thickness or the narrowest part
void check(const Problem& problem, const std::vector<geometry::CrackPath>& paths, EdgeMethod method);

/// A plate with edges along the axes as points: those of the lattice and, as fictitious points, the surface nodes in
/// their order, with what supports hold of them and nodal loads; with fictitious nodes behind these points of their
/// multipliers.
struct SurfaceLayout {
  Layout layout;
  SurfacePlate plate;
  geometry::Families families;  // of the points of the plate among each other, as cracks leave them; of others none
  SparseStiffness stiffness;    // of all points, three unknowns each; not symmetric
};

/// @param method   surface_nodes or fictitious_nodes
/// @throws Refused  other edges; holes and notches narrower than two horizons, edges shorter than one; cracks as near
/// to
///                  an edge as a horizon; edges that all but touch a row of points; supports by layers; loads on what
///                  is held
SurfaceLayout surface_layout(const Problem& problem, EdgeMethod method);

}  // namespace plate
