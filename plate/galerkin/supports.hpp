#pragma once
#include "plate/formulation/boundary.hpp"
#include "plate/galerkin/families.hpp"
#include "plate/model/nodal_forces.hpp"

namespace plate {

/// Supports on points that lie on the edges: w, psi_n, psi_s are held there, and nothing follows from outside.
/// `outline` in lattice units. `motions`: of supports that loads move. `map`: of the ranks that share the plate,
/// without its points. Of a membrane w is held everywhere.
Boundary galerkin_boundary(const geometry::Tessellation& cells, const std::vector<double>& areas,
                           const geometry::Outline& outline, const std::vector<Support>& supports,
                           const std::vector<SupportMotion>& motions = {}, PointMap map = {},
                           PlateLaw law = PlateLaw::bending);

}  // namespace plate
