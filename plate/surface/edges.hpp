#pragma once
#include <array>
#include <optional>
#include "geometry/shape/outline.hpp"
#include "plate/model/supports.hpp"

namespace plate {

/// What an edge is loaded with or brought to; what is not given is 0. M_nn and M_ns: tension where z > 0 is positive; s
/// is the outward normal n turned by +90 degrees.
struct EdgeAction {
  std::optional<double> shear = {}, moment = {}, twisting_moment = {};                    // Q, M_nn, M_ns, per length
  std::optional<double> deflection = {}, normal_rotation = {}, tangential_rotation = {};  // w, psi_n, psi_s
};

/// One of each pair of an edge is known: w or Q, psi_n or M_nn, psi_s or M_ns.
struct EdgeCondition {
  std::array<bool, 3> held;     // w, psi_n, psi_s
  std::array<double, 3> value;  // of those; of the others Q, M_nn, M_ns
};

/// How a support holds an edge, with what acts on it. `number`: of the support, for refusals.
/// @throws Refused  an action on what is held, or a value of what is not; supports by layers and pins
EdgeCondition edge_condition(SupportKind kind, const EdgeAction& action = {}, std::size_t number = 0);

/// The component of a state, 1 or 2, that is psi_n, psi_s but for its sign, of an edge whose normal lies along `axis`.
int normal_rotation(int axis);
int tangential_rotation(int axis);

/// w, theta_x, theta_y from w, psi_n, psi_s.
Eigen::Vector3d rotated(const Eigen::Vector3d& of_edge, const geometry::Point& normal);

/// Force and couples, conjugate to w, theta_x and theta_y, from Q, M_nn and M_ns (theory (26)), per length.
Eigen::Vector3d conjugate(const Eigen::Vector3d& section_forces, const geometry::Point& normal);

}  // namespace plate
