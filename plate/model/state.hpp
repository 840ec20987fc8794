#pragma once
#include <Eigen/Core>
#include <concepts>

#include "plate/model/space.hpp"

namespace plate {

/// Deflection and rotations of every point, one column each: w [length], theta_x, theta_y [rad]; in memory first all w.
/// u = z theta_y, v = -z theta_x; gamma_xz = w,x + theta_y, gamma_yz = w,y - theta_x.
template <typename Real>
using Values = Eigen::Matrix<Real, unknowns_per_point, Eigen::Dynamic, Eigen::RowMajor>;
using State = Values<double>;

/// Nodal forces work-conjugate to State: force [force], couples [force length].
using Forces = State;

/// Deflection and rotations of one point, or its force and couples.
using PointValues = Eigen::Matrix<double, unknowns_per_point, 1>;

/// Copy of a State with the values of a point together: its memory is counted by the degree of freedom.
using StateByPoints = Eigen::Matrix<double, unknowns_per_point, Eigen::Dynamic>;

/// State of zeros.
template <std::integral Count>
State zero_state(Count points) {
  return State::Zero(unknowns_per_point, static_cast<Eigen::Index>(points));
}

/// Forces of zeros.
template <std::integral Count>
Forces zero_forces(Count points) {
  return zero_state(points);
}

/// Zeros of the shape of another State or Forces.
inline State zero_like(const State& other) {
  return State::Zero(other.rows(), other.cols());
}

/// State without columns: stands for "none" where a state is optional.
inline State no_state() {
  return State(unknowns_per_point, 0);
}

/// Value of a degree of freedom in a State or Forces [3 x points].
template <typename Values>
decltype(auto) at_dof(Values&& values, const Dof& dof) {
  return values(dof.component, dof.point);
}

}  // namespace plate
