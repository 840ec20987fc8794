#pragma once
#include "geometry/cells/tessellation.hpp"
#include "plate/model/boundary.hpp"
#include "post/files/frame.hpp"

namespace post {

/// The points of the plate, and quadrilaterals and triangles between neighbouring lattice points whose sides are all
/// bonds: a crack appears as a gap one cell wide.
Mesh mesh(const plate::Boundary& boundary, const geometry::Families& families, std::vector<double> cut,
          double thickness);

/// The cells of the Galerkin plate: a crack appears as two faces. `areas` of the points [length^2].
Mesh mesh(const geometry::Tessellation& cells, const std::vector<double>& areas, std::vector<double> cut,
          double thickness);

}  // namespace post
