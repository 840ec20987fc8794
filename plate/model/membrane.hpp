#pragma once
#include "plate/model/problem.hpp"

namespace plate {

/// True where a load acts in the plane.
bool loaded_in_plane(const Problem& problem);

/// True where a plate has its plane beside it: loads act there, the middle plane stretches, bending and stretching are
/// coupled, or faces of cracks touch.
bool has_plane(const Problem& problem);

/// True where the equilibria of a plate and of its plane are found together: bending and stretching act on each other
/// by the section, or by faces of cracks that touch while soil lifts off or supports only push.
bool rests_with_plane(const Problem& problem);

/// Warning about stiffeners whose axial stiffness does nothing, as the plate has no plane beside it.
std::vector<std::string> warnings_about_axial_stiffness(const Problem& problem);

/// The plate in its plane (PlateLaw::membrane): what its supports hold there stands in their kinds, and its loads give
/// what they do there: temperatures have their mean in place of the difference between the faces (of sections that
/// couple each in place of the other). Of stiffeners their axial stiffness acts there; foundations and springs do not.
Problem membrane_of(Problem problem);

/// The coupling of the plate to its plane (PlateLaw::coupling): a section of stiffness B, and eccentric stiffeners.
Problem coupling_of(Problem problem);

}  // namespace plate
