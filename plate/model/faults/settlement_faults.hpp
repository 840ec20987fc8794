#pragma once
#include <vector>

#include "plate/model/refused.hpp"

namespace plate {

struct Problem;

/// Settlements of supports that there are not, that hold nothing of what is moved, or that meet others which hold the
/// same place elsewhere; settlements beside nodes at edges.
std::vector<Refusal> faults_of_settlements(const Problem& problem);

}  // namespace plate
