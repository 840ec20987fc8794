#pragma once
#include "plate/formulation/attached/attached_stiffness.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

struct Foundation;

/// The stiffness of a foundation under points in the middles of cells: its pressure under a deflection that is linear
/// in each cell acts as any pressure does (theory.md, "Elastic foundations"), the shear by differences between
/// neighbouring points, on either side of cracks too.
void add_foundation(const Foundation& foundation, const geometry::Cloud& cloud, AttachmentSum& sum);

/// The same under cells between points: by the linear function that their corners carry.
void add_foundation(const Foundation& foundation, const geometry::Tessellation& cells, AttachmentSum& sum);

}  // namespace plate
