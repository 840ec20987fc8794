#pragma once
#include "geometry/cells/tessellation.hpp"

namespace geometry {

/// About how many points a plate will have, told from its area, and from the integral of what graded points have more
/// about tips and holes: within 25 % where a plate is some ten spacings wide.
double expected_points(const Outline& outline, const std::vector<Tip>& tips, double spacing, const Grading& grading);

}  // namespace geometry
