#pragma once
#include "plate/model/section.hpp"

namespace plate {

/// Stresses xx, yy, xy by the strains xx, yy, 2 xy in the plane, without stress across it [force/length^2].
Eigen::Matrix3d plane_stress(const Orthotropy& material);

/// Shear stresses xz, yz by the shear angles [force/length^2].
Eigen::Matrix2d transverse_shear(const Orthotropy& material);

}  // namespace plate
