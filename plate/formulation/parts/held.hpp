#pragma once
#include "plate/formulation/formulation.hpp"
#include "plate/model/refused.hpp"

namespace plate {

/// What supports do not hold: pieces that may move as rigid bodies, or, where all are held, a part that hangs by bonds
/// along one line and that the load turns. Empty for a plate that can be in equilibrium with its loads.
std::vector<Refusal> loose(const Formulation& plate);

/// What is said of parts that can move without resistance. `statics`: its equilibrium is wanted.
std::vector<std::string> distrust_of_mechanisms(const Formulation& plate, bool statics);

}  // namespace plate
