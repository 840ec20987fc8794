#pragma once
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/solution.hpp"
#include "post/factors/tip_methods.hpp"

namespace fracture {

/// A plate with all that can be refused of its run behind it: nothing has been written yet.
struct Ready {
  struct Steps {
    double limit;
    plate::TimeGrid grid;
  };
  plate::Stopwatch stopwatch;
  std::unique_ptr<plate::Formulation> plate;
  std::vector<std::string> warnings;
  std::vector<post::TipMethods> tip_methods;
  std::optional<Steps> steps;  // of a motion; without a limit where it takes no steps but rows
  plate::BeginOfMotion begin;
  // of a plate that has been solved already:
  std::optional<plate::StaticResult> solution;
  std::optional<plate::LanczosMotion> motion;
};

}  // namespace fracture
