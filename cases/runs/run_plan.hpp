#pragma once
#include <filesystem>
#include <map>
#include <optional>

#include "fracture/growth/growth.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/srif.hpp"
#include "post/factors/tip_methods.hpp"

namespace plate {
struct Problem;
}

namespace cases {

/// Subject of a run, and the results wanted of it. All that it refers to must outlive it.
struct RunPlan {
  const plate::Problem& problem;
  const plate::Analysis& analysis;
  const std::optional<fracture::Growth>& growth;
  const std::optional<post::SrifOptions>& srif;  // where intensity factors are wanted
  const std::map<std::string, geometry::Point>& probes;
  std::string title, source, units;
  std::string formulation_reason;               // why the formulation is what it is
  std::optional<double> frames_every;           // in motion; absent: first and last only
  std::optional<double> rows_every;             // in motion; absent: duration / 400
  bool fields = true, states = true;            // for ParaView, to go on from
  std::optional<std::filesystem::path> report;  // the folder of report.html, where one is wanted
  bool quiet = false;                           // no progress

  bool grows_at_rest() const { return growth && analysis.kind == plate::Analysis::Kind::static_; }
  bool moves() const { return analysis.kind == plate::Analysis::Kind::dynamic; }
  bool si() const { return units == "SI"; }
};

/// Options for the steps of a motion: growth keeps a distance from the stable one.
plate::GridOptions grid_options(const RunPlan& plan);

/// A plate with all that can be refused of its run behind it: nothing has been written yet.
struct ValidatedPlate {
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

}  // namespace cases
