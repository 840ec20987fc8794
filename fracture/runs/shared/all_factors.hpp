#pragma once
#include "post/factors/srif.hpp"

namespace fracture {

/// The factors that all processes have found, by tips.
std::vector<post::Srif> of_all(std::vector<post::Srif> own);

}  // namespace fracture
