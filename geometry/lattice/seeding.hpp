#pragma once
#include "geometry/lattice/cloud.hpp"

namespace geometry {

/// The square lattice of cell centres inside the outline, row by row from the lower left, with the area of each cell
/// that lies in the plate. The lower left corner of the outline's bounding box is the corner of a cell.
/// `part`: of these cells only, in the same order; there may be none.
/// Throws std::invalid_argument where no cell centre lies inside the outline.
Cloud lattice(const Outline& outline, double spacing, const std::optional<CellBox>& part = {});

}  // namespace geometry
