#pragma once
#include <vector>

#include "cases/papers/bodies/equilibrium.hpp"
#include "plate/edges/multiplied_plate.hpp"
#include "plate/edges/surface_plate.hpp"

/// Bodies and plates of few nodes with their edges, and their equilibria by a factor of the whole matrix.
namespace edge_bodies {

using namespace plate;
using boundary_bodies::box_body;
using boundary_bodies::constrained_solution;
using boundary_bodies::ConstrainedSolution;
using boundary_bodies::MultipliedSolution;
using boundary_bodies::solution_with_multipliers;
using boundary_bodies::with_multipliers;

/// The points of a lattice, of which `corner` is the corner of a cell, inside the rectangle from `low` to `high`.
/// @throws Refused  a rectangle without points
LatticeBody rectangle_body(const geometry::Point& low, const geometry::Point& high, const geometry::Point& corner,
                           double spacing, int reach);

/// A plate on the lattice whose cells begin in its lower left corner.
SurfacePlate surface_plate(const Section& section, const Discretization& discretization, const geometry::Point& low,
                           const geometry::Point& high);

/// Values of real and surface nodes, and what holds the held unknowns, in their order.
/// @throws Refused  where the plate can move, and as stiffness() does
ConstrainedSolution solution(const SurfacePlate& plate, const EdgeConditions& edges, const AreaLoad& load);

/// Values of real nodes under these conditions and loads.
/// @throws Refused         where the plate can move, and as multiplied_plate() does
/// @throws NumericalError  where conditions contradict each other
Eigen::VectorXd multiplied_solution(const SurfacePlate& plate, const EdgeConditions& edges, const AreaLoad& load);

}  // namespace edge_bodies
