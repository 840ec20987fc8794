#pragma once
#include <Eigen/Core>

namespace plate {

struct Section;

/// Crack from one face of a plate through a part of its thickness, long along the face: the line spring of Rice and
/// Levy (1972), with the factors of a strip in tension and in bending of Tada, Paris and Irwin, within 0.5 %.
class PartThroughCrack {
public:
  static constexpr double deepest = 0.95;  // share of the thickness

  /// @param section  of the place, isotropic
  /// @param depth    of the front, up to `deepest` of the thickness; from 0 on [length]
  /// @param below    from z = -h/2 instead of z = h/2
  PartThroughCrack(const Section& section, double depth, bool below);

  /// N and M per length by the opening of the middle plane and the rotation, which opens the face z = h/2. A depth of 0
  /// gives nearly rigid springs [force/length^2, force; force, force].
  Eigen::Matrix2d stiffness() const;
  /// K of the front, lim sqrt(2 r) sigma, by N and M [force/length^(3/2)].
  double front_factor(const Eigen::Vector2d& resultants) const;

private:
  double share_, thickness_, modulus_, side_;  // depth / h; h; E / (1 - nu^2); +1 from above
};

/// Length of plate that gives as much as springs that are nearly rigid, as a share of the thickness.
inline constexpr double nearly_rigid = 1e-4;

}  // namespace plate
