#pragma once
#include <string>
#include <vector>

#include "plate/model/state.hpp"
#include "post/factors/srif.hpp"
#include "post/files/summary.hpp"

/// Runs that several processes share (plate/model/communicator.hpp): each holds a part of the plate and what it has
/// found there. Where one process holds the whole plate, all of this leaves things as they are.
namespace plate {
class Formulation;
}

namespace fracture {

struct RunPlan;

/// Feature of a run that processes cannot share yet: key of the case and why. None in one process.
struct Unshared {
  std::string key, why;
};
std::vector<Unshared> unshared(const RunPlan& plan);
/// The same whatever this process is.
std::vector<Unshared> not_for_processes(const RunPlan& plan);

/// Points and bonds of all processes, each counted by its owner.
void count_all(post::Summary& summary, const plate::Formulation& plate);

}  // namespace fracture
