#pragma once
#include <vector>

namespace plate {

struct FormulationKind;

/// Those that a problem may be solved with. What chooses by itself takes the first that can do what is asked for.
const std::vector<const FormulationKind*>& formulations();

}  // namespace plate
