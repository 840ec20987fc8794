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

/// An unknown that has its value.
struct PrescribedUnknown {
  Eigen::Index unknown;
  double value;
};

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
