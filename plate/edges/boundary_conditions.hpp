#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <optional>
#include <vector>

#include "geometry/shape/outline.hpp"
#include "plate/model/state.hpp"
#include "plate/model/supports.hpp"
#include "plate/solve/matrices/factor.hpp"

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
struct PrescribedUnknown {
  Eigen::Index unknown;
  double value;
};

/// u of K u = f without the rows of held unknowns, and what holds these: their rows of K u - f (Sca23 3.5).
struct ConstrainedSolution {
  Eigen::VectorXd values;
  Eigen::VectorXd reactions;  // in the order of the held unknowns
};

/// Boundary conditions on unknowns of surface nodes: values are held, fluxes are in f.
/// @throws NumericalError  where the body is loose
ConstrainedSolution constrained_solution(const SparseStiffness& K, const Eigen::VectorXd& f,
                                         const std::vector<PrescribedUnknown>& held);

/// The factors of a matrix that need not be symmetric, rows and columns scaled to their largest entries first: those of
/// values and of forces have other units.
class ScaledFactor {
public:
  /// @throws NumericalError  where the body is loose, or conditions contradict
  explicit ScaledFactor(const SparseStiffness& A);

  /// A^-1 b.
  /// @throws NumericalError  as the constructor
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  std::size_t bytes() const;

private:
  Eigen::VectorXd rows_, columns_;
  std::optional<GeneralFactor> factor_;  // none of an empty matrix
};

/// Prescribed loads, deflection or rotations of an edge; those not given are 0. M_nn and M_ns are positive for tension
/// where z > 0; s is the outward normal n turned by +90 degrees.
struct EdgeAction {
  std::optional<double> shear = {}, moment = {}, twisting_moment = {};                    // Q, M_nn, M_ns, per length
  std::optional<double> deflection = {}, normal_rotation = {}, tangential_rotation = {};  // w, psi_n, psi_s
};

/// Condition of an edge, with one known of each pair: w or Q, psi_n or M_nn, psi_s or M_ns.
struct EdgeCondition {
  std::array<bool, unknowns_per_point> held;     // w, psi_n, psi_s
  std::array<double, unknowns_per_point> value;  // of those; of the others Q, M_nn, M_ns
};

/// Condition with which a support holds an edge, with what acts on it. `number`: of the support, for refusals.
/// @throws Refused  an action on what is held, or a value of what is not; supports by layers and pins
EdgeCondition edge_condition(SupportKind kind, const EdgeAction& action = {}, std::size_t number = 0);

/// The component of a state, 1 or 2, that is psi_n, psi_s but for its sign, of an edge whose normal lies along `axis`.
int normal_rotation(int axis);
int tangential_rotation(int axis);

/// w, theta_x, theta_y from w, psi_n, psi_s.
PointValues rotated(const PointValues& of_edge, const geometry::Point& normal);

/// Force and couples, conjugate to w, theta_x and theta_y, from Q, M_nn and M_ns (theory (26)), per length.
PointValues conjugate(const PointValues& section_forces, const geometry::Point& normal);

}  // namespace plate
