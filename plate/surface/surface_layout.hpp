#pragma once
#include "plate/formulation/layout.hpp"
#include "plate/surface/surface_plate.hpp"

namespace plate {

/// A rectangle as points: those of the lattice and, as fictitious points, the surface nodes in their order, with what
/// supports hold of them and nodal loads.
struct SurfaceLayout {
  Layout layout;
  SurfacePlate plate;
  geometry::Families families;  // of the points of the plate among each other, as cracks leave them; of others none
};

/// @throws Refused  other outlines, holes; cracks as near to an edge as a horizon; edges that all but touch a row of
///                  points; supports by layers; loads on what is held
SurfaceLayout surface_layout(const Problem& problem);

}  // namespace plate
