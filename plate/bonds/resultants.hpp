#pragma once
#include "geometry/lattice/families.hpp"
#include "plate/formulation/bond_law.hpp"
#include "plate/formulation/resultants.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// By weighted least squares over the family of k (theory (43)); `state` includes fictitious points.
Gradients gradients(std::size_t k, const State& state, const geometry::Families& families,
                    const std::vector<BondShape>& shapes, const std::vector<double>& areas);

/// Resultants at the first `plate_points` points from weighted least-squares gradients over each family: curvatures
/// from the differences of the rotations, shear angles from the bond shear (exact for quadratic w with linear
/// rotations, so that thin plates show no spurious shear). `state` includes fictitious points.
Resultants resultants(const State& state, const geometry::Families& families, const std::vector<BondShape>& shapes,
                      const std::vector<double>& areas, std::size_t plate_points, const Section& section);

}  // namespace plate
