#pragma once
#include <Eigen/Core>

#include "plate/model/section.hpp"

namespace plate {

/// Section forces per length and the equivalent stress at z = +h/2. M > 0 is tension on the z > 0 face.
struct Resultants {
  Eigen::Matrix3Xd moments;   // Mxx, Myy, Mxy [force]
  Eigen::Matrix2Xd shear;     // Qx, Qy [force/length]
  Eigen::VectorXd von_mises;  // [force/length^2]
};

/// Gradients at a point.
struct Gradients {
  Eigen::Matrix2d theta = Eigen::Matrix2d::Zero();  // row: theta_x, theta_y; column: d/dx, d/dy
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();  // gamma_xz, gamma_yz
};

/// Of moments Mxx, Myy, Mxy, at z = +h/2 [force/length^2].
double von_mises(const Eigen::Vector3d& moments, const Section& section);

/// Resultants of these points, not yet set.
Resultants resultants_of(Eigen::Index points);

/// Sets those of point k. `theta`: as in Gradients. `shear`: shear force [force/length].
void set(Resultants& result, Eigen::Index k, const LocalSection& section, const Eigen::Matrix2d& theta,
         const Eigen::Vector2d& shear);

}  // namespace plate
