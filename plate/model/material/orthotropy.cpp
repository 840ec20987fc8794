#include "plate/model/material/orthotropy.hpp"

#include <cmath>
#include <numbers>

namespace plate {
namespace {

/// cos and sin of an angle in degrees, exact at right angles.
Eigen::Vector2d direction(double degrees) {
  const double quarter = std::round(degrees / 90), rest = (degrees - 90 * quarter) * std::numbers::pi / 180;
  const double c = std::cos(rest), s = std::sin(rest);
  switch ((int(std::fmod(quarter, 4)) + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

}  // namespace

Eigen::Matrix3d plane_stress(const Orthotropy& m) {
  const double nu21 = m.nu12 * m.E2 / m.E1, rest = 1 - m.nu12 * nu21;
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  own(0, 0) = m.E1 / rest, own(1, 1) = m.E2 / rest, own(0, 1) = own(1, 0) = nu21 * m.E1 / rest, own(2, 2) = m.G12;
  const auto n = direction(m.angle);
  const double c = n.x(), s = n.y();
  Eigen::Matrix3d turn;  // strains along the axes by those along x and y
  turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return turn.transpose() * own * turn;
}

Eigen::Matrix2d transverse_shear(const Orthotropy& m) {
  const auto n = direction(m.angle);
  Eigen::Matrix2d turn;
  turn << n.x(), n.y(), -n.y(), n.x();
  return turn.transpose() * Eigen::Vector2d(m.G13, m.G23).asDiagonal() * turn;
}

}  // namespace plate
