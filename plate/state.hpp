#pragma once
#include <Eigen/Core>

namespace plate {

/// Deflection and rotations of every point, one column each: w [length], theta_x, theta_y [rad].
/// u = z theta_y, v = -z theta_x; gamma_xz = w,x + theta_y, gamma_yz = w,y - theta_x.
using State = Eigen::Matrix3Xd;

/// Nodal forces work-conjugate to State: force [force], couples [force length].
using Forces = Eigen::Matrix3Xd;

}  // namespace plate
