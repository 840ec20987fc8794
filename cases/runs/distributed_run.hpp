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

struct Case;

/// A feature that ranks cannot share yet: the key of the case, and why.
struct NotDistributable {
  std::string key, why;
};
/// Features of a run that ranks cannot share. `processes`: their number; 0: not known.
std::vector<NotDistributable> not_for_processes(const Case& c, int processes = 0);

/// Counts points and bonds of all ranks, each by its owner; collective.
void count_all(post::Summary& summary, const plate::Formulation& plate);

}  // namespace cases
