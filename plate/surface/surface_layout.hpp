#pragma once
#include "plate/formulation/layout.hpp"
#include "plate/surface/surface_plate.hpp"

namespace plate {

/// A rectangle without cracks as points: those of the lattice and, as fictitious points, the surface nodes in their
/// order, with what supports hold of them and nodal loads.
struct SurfaceLayout {
  Layout layout;
  SurfacePlate plate;
};

/// @throws Refused  other outlines, holes, cracks; edges that all but touch a row of points; supports by layers; loads
/// on
///                  what is held
SurfaceLayout surface_layout(const Problem& problem);

}  // namespace plate
