#pragma once
#include "plate/formulation/formulation.hpp"
#include "plate/model/refused.hpp"

namespace plate {

/// What supports do not hold: pieces that may move as rigid bodies, or, where all are held, a part that hangs by bonds
/// along one line and that the load turns. Empty for a plate that can be in equilibrium with its loads.
std::vector<Refusal> loose(const Formulation& plate);

/// What is said of parts that can move without resistance.
std::vector<std::string> distrust_of_mechanisms(const Formulation& plate);

/// The part that hangs by bonds along one line and has the frequency 0 although every piece is held. Empty for a plate
/// that has no such part.
std::vector<Refusal> swinging(const Formulation& plate);

}  // namespace plate
