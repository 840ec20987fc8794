#pragma once
#include "plate/formulation/resultants.hpp"
#include "plate/formulation/sections/point_sections.hpp"
#include "plate/galerkin/law.hpp"

namespace plate {

/// From the mean strains of the Galerkin plate's families; shear forces with its shear scaling, which they contain.
Resultants resultants(const State& state, const GalerkinFamilies& families, const PointSections& sections);

}  // namespace plate
