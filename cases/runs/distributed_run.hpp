#pragma once
#include <vector>

#include "cases/input/problems.hpp"
#include "plate/model/state.hpp"
#include "post/factors/srif.hpp"
#include "post/files/summary.hpp"

/// Runs of a distributed plate: each rank holds a part of the plate and its results.
namespace plate {
class Formulation;
}

namespace cases {

struct Case;

/// Reasons why so many ranks cannot share the plate of a case; what never goes with several processes is in the table
/// of exclusions. `processes`: 0: not known.
std::vector<KeyError> errors_in_distribution(const Case& c, int processes = 0);

/// Counts points and bonds of all ranks, each by its owner; collective.
void count_all(post::Summary& summary, const plate::Formulation& plate);

}  // namespace cases
