#pragma once
#include "plate/galerkin/operator.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// K of all degrees of freedom. Any number of threads gives the same bits.
PointMatrix stiffness_matrix(const GalerkinOperator& plate);

/// Without what is attached to the plate.
PointMatrix stiffness_matrix(const GalerkinFamilies& families, const PointSections& sections);

}  // namespace plate
