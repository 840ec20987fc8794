#pragma once
#include "plate/formulation/attached/attached_stiffness.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// The matrix and what is attached; the matrix itself where nothing is.
PointMatrix with(PointMatrix matrix, const AttachedStiffness& attached);

/// The matrix and a number for every degree of freedom on its diagonal.
PointMatrix plus(PointMatrix matrix, const Forces& diagonal);

}  // namespace plate
