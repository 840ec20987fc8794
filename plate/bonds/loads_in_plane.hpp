#pragma once
#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/state.hpp"
#include "plate/model/supports.hpp"

namespace plate {

/// Nodal forces of a load in the plane [3 x points], conjugate to theta_x = -v and theta_y = u. The points about the
/// place of a force that no crack parts from it share it, so that force and moment stay. Forces on an edge are shared
/// down to a spacing below the horizon, where the bonds of a constant stress end. Components that one of `supports`
/// (kinds of membrane_of()) holds on the edge are left out. `outline` and `paths` [length].
/// @throws Refused  where a place sees no point
Forces forces_in_plane(const Load& load, const Boundary& boundary, const geometry::Outline& outline,
                       const std::vector<geometry::CrackPath>& paths, double horizon_ratio,
                       const std::vector<Support>& supports = {});

}  // namespace plate
