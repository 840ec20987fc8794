#pragma once
#include "plate/model/loading/load_cases.hpp"

namespace plate {

/// What of a problem loads by temperature cannot have: a section without thermal expansion, edges and corrections of
/// bonds under which a bent plate is not free of stress.
std::vector<KeyFault> faults_of_heat(const Problem& problem);

}  // namespace plate
