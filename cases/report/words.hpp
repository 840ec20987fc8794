#pragma once
#include "fracture/growth/ended.hpp"
#include "fracture/growth/motion/moving_growth.hpp"

namespace cases {

/// How a growth at rest ended. `by_bonds`: of bonds that break one by one.
std::string in_words(const fracture::Ended& ended, bool by_bonds);

/// What became of a growth in motion.
std::string in_words(const fracture::Moved& moved);

}  // namespace cases
