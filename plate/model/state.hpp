#pragma once
#include <Eigen/Core>

namespace plate {

/// Deflection and rotations of every point, one column each: w [length], theta_x, theta_y [rad]; in memory first all w.
/// u = z theta_y, v = -z theta_x; gamma_xz = w,x + theta_y, gamma_yz = w,y - theta_x.
template <typename Real>
using Values = Eigen::Matrix<Real, 3, Eigen::Dynamic, Eigen::RowMajor>;
using State = Values<double>;

/// Nodal forces work-conjugate to State: force [force], couples [force length].
using Forces = State;

/// Degree of freedom 3 * point + component of a State or Forces.
template <typename Values>
decltype(auto) at_dof(Values&& values, std::size_t dof) {
  return values(static_cast<Eigen::Index>(dof % 3), static_cast<Eigen::Index>(dof / 3));
}

}  // namespace plate
