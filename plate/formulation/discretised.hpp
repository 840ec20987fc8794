#pragma once
#include <memory>
#include <string>
#include <vector>

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/stopwatch.hpp"

namespace plate {

/// A problem turned into a plate, with what its user should know, and the seconds that it took.
struct Discretised {
  std::unique_ptr<Formulation> plate;
  std::vector<std::string> warnings;
  Stopwatch stopwatch;
};

/// By the formulation of the problem. Throws Refused where it cannot carry the problem, or the machine has no memory
/// for so many points. Whether the plate is held is not asked here.
Discretised discretise(const Problem& problem);

/// Throws Refused where the machine has not even the memory for the points, as discretise() does.
void require_memory(const Problem& problem);

}  // namespace plate
