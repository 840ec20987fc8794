#pragma once
#include <string>
#include <vector>

#include "plate/model/refused.hpp"

namespace plate {

class Formulation;
struct Analysis;

/// What keeps a plate from its analysis, and what one should know of it.
struct Suitability {
  std::vector<Refusal> refusals;
  std::vector<std::string> warnings;
};

/// Fewer modes than frequencies are asked for, pins within a spacing of one line, an equilibrium of a plate that is not
/// held, in whole or in a piece that cracks cut off, a preconditioner that cannot be made.
Suitability suitability(const Formulation& plate, const Analysis& analysis);

}  // namespace plate
