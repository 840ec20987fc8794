#pragma once
#include "plate/formulation/attached/attached_stiffness.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct Problem;

/// All foundations and springs of a problem on points in the middles of cells.
AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Cloud& cloud);

/// The same on points on the edges and between them.
AttachedStiffness attached_stiffness(const Problem& problem, const geometry::Tessellation& cells);

}  // namespace plate
