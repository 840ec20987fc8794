#pragma once
#include "cases/input/case.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "post/factors/tip_methods.hpp"

namespace plate {
class Formulation;
}

namespace cases {

/// The motion of a held Galerkin plate by Lanczos vectors that hold the factors of every tip with a fit to `truncation`
/// of the largest that it ever has, as far as LanczosOptions::watched_tolerance goes; truncated() has one entry per
/// tip, 0 without a fit. `plate` must outlive it. Throws NumericalError.
plate::LanczosMotion lanczos_motion(const Case& c, const plate::Formulation& plate,
                                    const std::vector<post::TipMethods>& methods, double truncation,
                                    const std::function<void(std::size_t vectors, double change)>& progress);

}  // namespace cases
