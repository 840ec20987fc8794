#pragma once
#include <vector>
#include "geometry/shape/crack_path.hpp"
#include "plate/model/problem.hpp"

namespace plate {

/// Can surface nodes or fictitious nodes serve these edges, cracks and points?
/// @throws Refused  with fictitious nodes edges that are not along the axes, else those shorter than half a spacing;
/// holes and notches narrower than two horizons, edges shorter than
///                  one; cracks as near to an edge as a horizon; horizons wide for the thickness or the narrowest part
void check(const Problem& problem, const std::vector<geometry::CrackPath>& paths, EdgeMethod method);

}  // namespace plate
