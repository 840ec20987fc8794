#pragma once
#include <map>
#include <optional>
#include <string>

#include "geometry/shape/outline.hpp"

namespace cases {

/// What a run writes beside its tables, and how often.
struct Output {
  bool vtk = true, hdf5 = true;
  std::optional<bool> report;   // absent: where fields are written
  std::optional<double> every;  // dynamic: time between frames; absent: first and last only
  std::optional<double>
      history_every;             // dynamic: time between rows of history, probes and SRIFs; absent: duration / 400
  double checkpoint_every = 60;  // [s] of the clock; 0: never
  std::map<std::string, geometry::Point> probes;

  bool reports() const { return report.value_or(vtk || hdf5); }
};

}  // namespace cases
