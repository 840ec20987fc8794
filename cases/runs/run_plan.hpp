#pragma once
#include <filesystem>
#include <string>

#include "plate/model/point_map.hpp"

namespace plate {
struct Discretization;
struct GridOptions;
}  // namespace plate

namespace post {
struct ReportedCase;
struct ResultsInMemory;
}  // namespace post

namespace cases {

struct Case;

/// Options of a run beside its case, as the command line gives them.
struct RunOptions {
  std::filesystem::path folder;                // results go here; made if it does not exist
  bool quiet = false;                          // no progress
  post::ResultsInMemory* in_memory = nullptr;  // results go here instead, and no file is written
  bool resume = false;                         // goes on from what an earlier run has kept in the folder
  const plate::Communicator* communicator = &plate::single_process();

  /// Options of a run that belongs to this one.
  RunOptions part(const std::string& name) const;
};

/// Plan of a run: its case, which must outlive it, and its options.
struct RunPlan {
  const Case& content;
  RunOptions options = {};

  /// True where report.html is wanted in the folder.
  bool reports() const;
};

/// Options for the steps of a motion: growth keeps a distance from the stable one.
plate::GridOptions grid_options(const Case& c);

/// Points that are so much wider apart, and graded as much.
plate::Discretization widened(plate::Discretization points, double wider);

}  // namespace cases
