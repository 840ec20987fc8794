#pragma once
#include <vector>

#include "plate/edges/multiplied_plate.hpp"
#include "plate/edges/surface_plate.hpp"

/// Bodies and plates of few nodes with their edges, and their equilibria by a factor of the whole matrix.
namespace edge_bodies {

using namespace plate;

/// A bar, a rectangle or a box of `counts` nodes, faces half a spacing beyond its nodes.
LatticeBody box_body(const std::vector<int>& counts, int reach);

/// The points of a lattice, of which `corner` is the corner of a cell, inside the rectangle from `low` to `high`.
/// @throws Refused  a rectangle without points
LatticeBody rectangle_body(const geometry::Point& low, const geometry::Point& high, const geometry::Point& corner,
                           double spacing, int reach);

/// A plate on the lattice whose cells begin in its lower left corner.
SurfacePlate surface_plate(const Section& section, const Discretization& discretization, const geometry::Point& low,
                           const geometry::Point& high);

/// u and multipliers of K u + B^T multipliers = f, B u = c (Sca21 61-63). Where the extrapolation carries the solution
/// exactly, equilibrium needs no multipliers and they are rounding; else they say how far conditions and equilibrium
/// are apart: those of values in forces, those of fluxes in displacements, together as the forces that they add.
struct MultipliedSolution {
  Eigen::VectorXd values, multipliers, added_forces;  // B^T multipliers
};

/// [K B^T; B 0] (Sca21 63).
SparseStiffness with_multipliers(const SparseStiffness& K, const SparseStiffness& B);

/// Boundary conditions by Lagrange multipliers: values and fluxes are rows of B. What holds the body is the flux
/// through its faces (Sca21, remark 3), not the multipliers.
/// @throws NumericalError  where conditions contradict each other or leave the body loose
MultipliedSolution solution_with_multipliers(const SparseStiffness& K, const SparseStiffness& B,
                                             const Eigen::VectorXd& f, const Eigen::VectorXd& c);

/// u of K u = f without the rows of held unknowns, and what holds these: their rows of K u - f (Sca23 3.5).
struct ConstrainedSolution {
  Eigen::VectorXd values;
  Eigen::VectorXd reactions;  // in the order of the held unknowns
};

/// Boundary conditions on unknowns of surface nodes: values are held, fluxes are in f.
/// @throws NumericalError  where the body is loose
ConstrainedSolution constrained_solution(const SparseStiffness& K, const Eigen::VectorXd& f,
                                         const std::vector<PrescribedUnknown>& held);

/// Values of real and surface nodes, and what holds the held unknowns, in their order.
/// @throws Refused  where the plate can move, and as stiffness() does
ConstrainedSolution solution(const SurfacePlate& plate, const EdgeConditions& edges, const AreaLoad& load);

/// Values of real nodes under these conditions and loads.
/// @throws Refused         where the plate can move, and as multiplied_plate() does
/// @throws NumericalError  where conditions contradict each other
Eigen::VectorXd multiplied_solution(const SurfacePlate& plate, const EdgeConditions& edges, const AreaLoad& load);

}  // namespace edge_bodies
