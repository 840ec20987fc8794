#pragma once
#include <Eigen/Core>

#include "plate/model/space.hpp"

namespace plate {

/// Deflection and rotations of every point, one column each: w [length], theta_x, theta_y [rad]; in memory first all w.
/// u = z theta_y, v = -z theta_x; gamma_xz = w,x + theta_y, gamma_yz = w,y - theta_x.
template <typename Real>
using Values = Eigen::Matrix<Real, unknowns_per_point, Eigen::Dynamic, Eigen::RowMajor>;
using State = Values<double>;

/// Nodal forces work-conjugate to State: force [force], couples [force length].
using Forces = State;

/// Value of a degree of freedom in a State or Forces [3 x points].
template <typename Values>
decltype(auto) at_dof(Values&& values, std::size_t dof) {
  return values(static_cast<Eigen::Index>(component_of(dof)), static_cast<Eigen::Index>(point_of(dof)));
}

}  // namespace plate
