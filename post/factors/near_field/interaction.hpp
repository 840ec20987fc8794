#pragma once
#include <vector>

#include "post/factors/near_field/tip_section.hpp"
#include "post/factors/series_fit.hpp"

namespace post {

/// Error of their K3 over the largest factor, where a spacing is a thickness: leading fields of moments and of shear
/// meet in an integral of 1 / r about the tip. Measured on isotropic plates against fits, a crack at 40 degrees.
inline constexpr double interaction_error = 0.6;

/// K1, K2, K3 by interaction integrals with the leading fields (theory.md, "Sections with directions"), over each of
/// the rings; of sections of any kind that are the same all over the rings. Functionals of the state as those of fits.
/// Loads in the ring are left out: they act on K3 alone, by what of them is odd about the crack.
std::vector<SeriesFit> interaction_integrals(const TipView& plate, const geometry::Tip& tip, const TipSection& at,
                                             const std::vector<Ring>& rings);

}  // namespace post
