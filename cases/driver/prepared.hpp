#pragma once
#include "cases/driver/run.hpp"
#include "cases/input/case_file.hpp"
#include "plate/formulation/stopwatch.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/solution.hpp"
#include "post/factors/tip_methods.hpp"

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
  plate::Stopwatch stopwatch;
  std::unique_ptr<plate::Formulation> plate;
  std::vector<std::string> warnings;
  std::vector<post::TipMethods> tip_methods;
  std::optional<Steps> steps;  // of a motion; without a limit where it takes no steps but rows
  // of a plate that has been solved already:
  std::optional<plate::StaticResult> solution;
  std::optional<plate::LanczosMotion> motion;
};

}  // namespace cases
