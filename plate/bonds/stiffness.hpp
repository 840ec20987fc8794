#pragma once
#include "plate/bonds/family_operator.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// K of all degrees of freedom. `with_dilatation` = false leaves out the energy a theta^2 and with it the couplings
/// between the neighbours of a point. `wanted`: points whose columns are made; empty: all. Any number of threads gives
/// the same bits.
PointMatrix stiffness_matrix(const FamilyOperator& plate, bool with_dilatation, const std::vector<char>& wanted = {});

}  // namespace plate
