#pragma once
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/mesh.hpp"

namespace plate {

/// The points of the plate, squares between them, and triangles up to edges, holes and cracks (geometry::drawn_cells).
/// `cracks` [length]. Points alone where edges and cracks are too close to each other for cells.
Mesh mesh(const Boundary& boundary, const geometry::Outline& outline, const std::vector<geometry::CrackPath>& cracks,
          std::vector<double> cut, double thickness);

}  // namespace plate
