#pragma once
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/mesh.hpp"

namespace plate {

/// The points of the plate, and quadrilaterals and triangles between neighbouring lattice points whose sides are all
/// bonds: a crack appears as a gap one cell wide.
Mesh mesh(const Boundary& boundary, const geometry::Families& families, std::vector<double> cut, double thickness);

}  // namespace plate
