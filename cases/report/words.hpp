#pragma once
#include "fracture/growth/ended.hpp"

namespace cases {

/// How a quasi-static growth ended. `by_bonds`: of bonds that break one by one.
std::string in_words(const fracture::Ended& ended, bool by_bonds);

/// What became of a growth in motion.
std::string in_words(const fracture::Moved& moved);

}  // namespace cases
