#pragma once
#include <Eigen/SparseCore>
#include <vector>

namespace plate {

/// The stiffness of extrapolated bodies, not symmetric; both ways of solving factorise the whole matrix.
using SparseStiffness = Eigen::SparseMatrix<double>;

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

/// An unknown that has its value.
struct HeldUnknown {
  Eigen::Index unknown;
  double value;
};

/// u of K u = f without the rows of held unknowns, and what holds these: their rows of K u - f (Sca23 3.5).
struct HeldSolution {
  Eigen::VectorXd values;
  Eigen::VectorXd reactions;  // in the order of the held unknowns
};

/// Boundary conditions on unknowns of surface nodes: values are held, fluxes are in f.
/// @throws NumericalError  where the body is loose
HeldSolution solution_held(const SparseStiffness& K, const Eigen::VectorXd& f, const std::vector<HeldUnknown>& held);

}  // namespace plate
