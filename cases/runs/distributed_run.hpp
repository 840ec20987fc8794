#pragma once
#include <string>
#include <vector>

#include "plate/model/state.hpp"
#include "post/factors/srif.hpp"
#include "post/files/summary.hpp"

/// Runs of a distributed plate: each rank holds a part of the plate and its results.
namespace plate {
class Formulation;
}

namespace cases {

struct RunPlan;

/// A feature that ranks cannot share yet: the key of the case, and why.
struct NotDistributable {
  std::string key, why;
};
/// Features of a run that its ranks cannot share; empty for a single process.
std::vector<NotDistributable> not_distributable(const RunPlan& plan);
/// Features of a run that ranks could not share, whether or not there are several now.
std::vector<NotDistributable> not_for_processes(const RunPlan& plan);

/// Counts points and bonds of all ranks, each by its owner; collective.
void count_all(post::Summary& summary, const plate::Formulation& plate);

}  // namespace cases
