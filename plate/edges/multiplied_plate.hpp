#pragma once
#include "plate/edges/surface_plate.hpp"

namespace plate {

/// Fictitious nodes without unknowns on the edges (Sca21, for the Mindlin plate): what they are is expanded about the
/// nearest real node, and the conditions at edges are rows with Lagrange multipliers (Sca21 61-63). Unknowns, three
/// each: of real nodes, of surface nodes (the values there, which follow), of surface nodes again (multipliers).
///
/// Rows of real nodes: K u + B^T multipliers = f. Rows of surface nodes: fluxes; of what is held by crossing points and
/// less the multipliers, which is what holds the plate: multipliers of values are forces at the edge, those of fluxes
/// have no resultant. Rows of multipliers: the values at the edges from those of real nodes, less those of surface
/// nodes.
struct MultipliedPlate {
  SparseStiffness stiffness;
  std::vector<int> idle;  // unknowns of multipliers that are 0: conditions at corners that the others imply
};

/// Values of all nodes from those of real nodes: 3 nodes x 3 real.
WeightRows expansion_of_real(const SurfacePlate& plate);

/// `held`: of the unknowns of surface nodes, three each, those that have their values; of the others the fluxes are
/// known.
/// @throws std::invalid_argument  orders as stiffness() does
/// @throws Refused                where the plate has too few points for the orders
MultipliedPlate multiplied_plate(const SurfacePlate& plate, const std::vector<char>& held);

/// Sizes of the forces that multipliers add on real nodes, couples over `arm` [force].
/// @param values  of all unknowns
double added_forces(const SparseStiffness& stiffness, const SurfacePlate& plate, const Eigen::VectorXd& values,
                    double arm);

}  // namespace plate
