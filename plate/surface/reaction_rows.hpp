#pragma once
#include <functional>
#include "plate/surface/surface_plate.hpp"

namespace plate {

using StiffnessRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Rows of real and surface nodes by the lever, `own`, but for what is held: these by crossing points, `crossed`, so
/// that reactions leave nothing out. By the lever a bond over a corner of a held and a free edge puts on the free one
/// what its crossing point does not: fluxes by crossing points there are not 0 although those by the lever are. What
/// they sum up to within the nearer half of a free stretch is a force on the held face beside its end, and is added
/// there, with its couple about that face where it holds it. Nothing of it in homogeneous states, where both rules are
/// exact.
StiffnessRows rows_with_reactions(const SurfacePlate& plate, const StiffnessRows& own, const StiffnessRows& crossed,
                                  const std::function<bool(int unknown)>& held);

}  // namespace plate
