#pragma once
#include <array>
#include <complex>
#include <vector>

#include "plate/formulation/tip_view.hpp"
#include "post/factors/series_fit.hpp"
#include "post/factors/tip_section.hpp"

namespace post {

/// The leading fields about a tip of unit K1, K2 and K3 (theory.md, "Sections with directions"): plane stress of the
/// rotations (Sih, Paris and Irwin 1965) and a deflection as of antiplane shear.
class LeadingFields {
public:
  explicit LeadingFields(const TipSection& at, const geometry::Point& ahead);

  /// Gradients at a place that is not the tip, along x and y: of psi for unit K1 and K2, row psi_x, psi_y.
  std::array<Eigen::Matrix2d, 2> rotations(const plate::Polar& at) const;
  /// Gradient of w for unit K3 at a place that is not the tip, along x and y.
  Eigen::Vector2d deflection(const plate::Polar& at) const;

private:
  Eigen::Matrix2d axes_;  // columns: ahead, to the left
  std::array<std::complex<double>, 2> roots_;
  Eigen::Matrix2cd u_, v_;  // -psi ahead and to the left by the root of z_1 and z_2 (columns), for K1 and K2 (rows)
  std::complex<double> root_of_shear_;
  double deflection_;
};

/// Error of their K3 over the largest factor, where a spacing is a thickness: leading fields of moments and of shear
/// meet in an integral of 1 / r about the tip. Measured on isotropic plates against fits, a crack at 40 degrees.
inline constexpr double interaction_error = 0.6;

/// K1, K2, K3 by interaction integrals with the leading fields (theory.md, "Sections with directions"), over each of
/// the rings; of sections of any kind that are the same all over the rings. Functionals of the state as those of fits.
/// Loads in the ring are left out: they act on K3 alone, by what of them is odd about the crack.
std::vector<SeriesFit> interaction_integrals(const TipView& plate, const TipFrame& frame, const TipSection& at,
                                             const std::vector<Ring>& rings);

/// Part of free curvatures that vary in those of a ring.
Eigen::Vector3d interaction_of_free_curvatures(const TipView& plate, const TipFrame& frame, const TipSection& at,
                                               const Ring& ring, const FreeCurvatures& free);

}  // namespace post
