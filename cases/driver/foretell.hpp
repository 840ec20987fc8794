#pragma once
#include "cases/input/case_file.hpp"
#include "plate/usual_solver.hpp"
#include "post/studies/foretold.hpp"

namespace cases {

/// What a run will be, told from runs of the same case with fewer points, written to a folder that is removed.
struct ForetoldRun {
  double points = 0, bonds = 0;
  plate::UsualSolver solver;             // of statics
  double time_step = 0, time_limit = 0;  // of a motion that takes steps
  post::WholeRun whole;
  post::Foretold costs;
  double bytes = 0;               // of memory at its peak
  std::size_t sample_points = 0;  // of the larger sample
};

/// Throws CaseError where no sample of up to 50,000 points can carry the case, and neither can the case itself.
ForetoldRun foretell(const CaseFile& file);

}  // namespace cases
