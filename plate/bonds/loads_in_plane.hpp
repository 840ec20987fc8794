#pragma once
#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/state.hpp"
#include "plate/model/supports.hpp"

namespace plate {

/// Nodal forces [3 x points] of what a load does in the plane, conjugate to theta_x = -v and theta_y = u: every force
/// by the points about its place that no crack parts from it, so that forces and their moments are those of the load.
/// Those of edges reach a spacing deeper than the horizon, as the bonds of a constant stress do there, without what
/// `supports` (kinds of membrane_of()) hold there. `outline` and `paths` in lengths.
/// @throws Refused  where a place sees no point
Forces forces_in_plane(const Load& load, const Boundary& boundary, const geometry::Outline& outline,
                       const std::vector<geometry::CrackPath>& paths, double horizon_ratio,
                       const std::vector<Support>& supports = {});

}  // namespace plate
