#pragma once
#include <array>
#include <complex>

#include "plate/formulation/tip_frame.hpp"
#include "post/factors/near_field/tip_section.hpp"

namespace post {

/// The leading fields about a tip of unit K1, K2 and K3 (theory.md, "Sections with directions"): plane stress of the
/// rotations (Sih, Paris and Irwin 1965) and a deflection as of antiplane shear.
class LeadingFields {
public:
  explicit LeadingFields(const TipSection& at, const geometry::Point& ahead);

  /// Gradients at a place that is not the tip, along x and y: of psi for unit K1 and K2, row psi_x, psi_y.
  std::array<Eigen::Matrix2d, 2> rotations(const plate::Polar& at) const;
  /// Of w for unit K3.
  Eigen::Vector2d deflection(const plate::Polar& at) const;

private:
  Eigen::Matrix2d axes_;  // columns: ahead, to the left
  std::array<std::complex<double>, 2> roots_;
  Eigen::Matrix2cd u_, v_;  // -psi ahead and to the left by the root of z_1 and z_2 (columns), for K1 and K2 (rows)
  std::complex<double> root_of_shear_;
  double deflection_;
};

}  // namespace post
