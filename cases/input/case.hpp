#pragma once
#include <map>
#include <optional>
#include "fracture/growth/criteria.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "post/factors/srif.hpp"

/// The application: case files in, results out.
namespace cases {

using plate::Analysis;

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

/// One whole simulation, as plain data: a plate, and what is done with it.
struct Case : plate::Problem {
  std::string title, source, units = "none";
  std::string formulation_reason = "as the case says";  // why discretization.formulation is what it is
  Analysis analysis;
  std::optional<fracture::Growth> growth;
  std::optional<post::SrifOptions> srif;
  Output output;
};

}  // namespace cases
