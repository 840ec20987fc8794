#pragma once
#include <vector>

#include "post/factors/near_field/tip_section.hpp"
#include "post/factors/series_fit.hpp"

namespace post {

/// K1, K2, K3 by interaction integrals with the leading fields (theory.md, "Sections with directions"), over each of
/// the rings; of sections of any kind that are the same all over the rings. Functionals of the state as those of fits.
/// Loads in the ring are left out: they act on K3 alone, by what of them is odd about the crack.
std::vector<SeriesFit> interaction_integrals(const TipView& plate, const geometry::Tip& tip, const TipSection& at,
                                             const std::vector<Ring>& rings);

}  // namespace post
