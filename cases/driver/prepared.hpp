#pragma once
#include "cases/driver/run.hpp"
#include "cases/driver/static_solution.hpp"
#include "cases/driver/tip_factors.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"

namespace cases {

/// A case with all that can be refused behind it: nothing has been written yet. Stays where it is made.
struct Prepared {
  struct Steps {
    double limit;
    TimeGrid grid;
  };
  /// Throws CaseError.
  explicit Prepared(CaseFile wanted);
  Prepared(const Prepared&) = delete;

  CaseFile file;
  Stopwatch stopwatch;
  Assembly assembly;
  std::vector<post::TipMethods> tip_methods;
  std::optional<Steps> steps;            // of a motion; without a limit where it takes no steps but rows
  // of a plate that has been solved already:
  std::optional<StaticResult> solution;
  std::optional<plate::LanczosMotion> motion;
};

}  // namespace cases
