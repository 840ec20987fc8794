#pragma once
#include <vector>
#include "post/factors/tip_integrals.hpp"

namespace post {

/// Distance from a tip within which the plate is whole but for its own crack, which is straight there: from edges,
/// holes, other cracks, other ends and bends of its own [length].
double clear_distance(const geometry::Outline& outline, const std::vector<geometry::CrackPath>& paths,
                      const geometry::Tip& tip, double spacing);

/// The tip moved half way between the points on either side of the last sixteen spacings of the crack: on a lattice,
/// the crack is what parts the points, wherever between them it is drawn.
geometry::Tip centred(const geometry::Tip& tip, const TipView& plate);

/// The rings about a tip, the recommended one first: outer radii of 16, 11, 24 and 7 spacings, inner radii half of
/// them, as far as they fit into `clear`; where none does, one as large as fits. Empty where not even 4 spacings fit.
/// In graded points, where any ring has as many points across as another that is as wide in proportion, shares of
/// `clear`, and an eighth inside. `spacing`: at the tip.
std::vector<Ring> rings(double clear, double spacing, bool graded);

}  // namespace post
