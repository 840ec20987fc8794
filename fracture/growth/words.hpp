#pragma once
#include "fracture/growth/ended.hpp"

namespace fracture {

/// How a quasi-static growth ended. `by_bonds`: of bonds that break one by one.
std::string in_words(const Ended& ended, bool by_bonds);

/// What became of a growth in motion.
std::string in_words(const Moved& moved);

}  // namespace fracture
