#pragma once
#include "cases/driver/assembly.hpp"
#include "post/files/frame.hpp"
#include "post/factors/tip_methods.hpp"

/// What is drawn and found in a plate whose bonds have broken: with families that are less than those of the assembly.
namespace cases {

/// The cells between points that still see each other; sets the frame's resultants and damage.
post::Mesh severed_frame(const Case& content, const Assembly& assembly, const geometry::Families& families, post::Frame& frame,
                         const plate::State& state);

/// Throws std::invalid_argument where no method can work at the tip. `reach`: largest radius of rings [length].
post::TipMethods severed_tip_methods(const Case& content, const Assembly& assembly, const geometry::Families& families,
                                     const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip,
                                     const post::SrifOptions& options, double reach = INFINITY);

}  // namespace cases
