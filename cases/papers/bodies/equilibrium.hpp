#pragma once
#include <vector>

#include "plate/edges/boundary_conditions.hpp"
#include "plate/edges/lattice_body.hpp"

/// Bodies of few nodes and their equilibria by a factor of the whole matrix.
namespace boundary_bodies {

/// A bar, a rectangle or a box of `counts` nodes, faces half a spacing beyond its nodes.
plate::LatticeBody box_body(const std::vector<int>& counts, int reach);

/// u and multipliers of K u + B^T multipliers = f, B u = c (Sca21 61-63). Where the extrapolation carries the solution
/// exactly, equilibrium needs no multipliers and they are rounding; else they say how far conditions and equilibrium
/// are apart: those of values in forces, those of fluxes in displacements, together as the forces that they add.
struct MultipliedSolution {
  Eigen::VectorXd values, multipliers, added_forces;  // B^T multipliers
};

/// [K B^T; B 0] (Sca21 63).
plate::SparseStiffness with_multipliers(const plate::SparseStiffness& K, const plate::SparseStiffness& B);

/// Boundary conditions by Lagrange multipliers: values and fluxes are rows of B. What holds the body is the flux
/// through its faces (Sca21, remark 3), not the multipliers.
/// @throws NumericalError  where conditions contradict each other or leave the body loose
MultipliedSolution solution_with_multipliers(const plate::SparseStiffness& K, const plate::SparseStiffness& B,
                                             const Eigen::VectorXd& f, const Eigen::VectorXd& c);

/// u of K u = f without the rows of held unknowns, and what holds these: their rows of K u - f (Sca23 3.5).
struct ConstrainedSolution {
  Eigen::VectorXd values;
  Eigen::VectorXd reactions;  // in the order of the held unknowns
};

/// Boundary conditions on unknowns of surface nodes: values are held, fluxes are in f.
/// @throws NumericalError  where the body is loose
ConstrainedSolution constrained_solution(const plate::SparseStiffness& K, const Eigen::VectorXd& f,
                                         const std::vector<plate::PrescribedUnknown>& held);

}  // namespace boundary_bodies
