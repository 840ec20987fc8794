#pragma once
#include "plate/model/problem.hpp"

namespace plate {

/// True where a load acts in the plane.
bool loaded_in_plane(const Problem& problem);

/// The plate in its plane (PlateLaw::membrane): what its supports hold there stands in their kinds, and its loads give
/// what they do there: temperatures have their mean in place of the difference between the faces. Foundations, springs
/// and stiffeners do not act in the plane.
Problem membrane_of(Problem problem);

}  // namespace plate
