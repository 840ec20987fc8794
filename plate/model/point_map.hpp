#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plate {

class Communicator;
/// The communicator of a program that is one process: nothing is exchanged, plates are not discretised in parts.
const Communicator& single_process();

/// Map of the points that a rank knows: those that it owns; the others are ghosts. One process owns all: both lists are
/// empty.
struct PointMap {
  const Communicator* communicator = &single_process();  // must outlive it
  std::vector<char> owned = {};                          // of all points
  std::vector<std::uint32_t> global = {};                // global numbers, where points are in no lattice

  int rank() const;
  bool distributed() const;
  bool owns(std::size_t k) const { return owned.empty() || owned[k]; }
};

}  // namespace plate
