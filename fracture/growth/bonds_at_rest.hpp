#pragma once
#include <functional>
#include <string>

#include "fracture/growth/bond_check.hpp"
#include "fracture/growth/rest_load.hpp"

namespace fracture {

/// A plate at rest under the whole load.
struct LoadedState {
  std::string split;        // not empty: a piece of the plate is not held any more, and nothing could be solved
  double displacement = 0;  // sum of loads times displacements [energy]
  const plate::State* state = nullptr;
};

/// One state at rest on the way, just before bonds break.
struct BondEvent {
  std::size_t advance;  // number of it; the first state is 0
  double critical;      // load factor at which the next bonds break; infinite where none does
  bool stable;          // no load that was reached before would have been enough
  const RestLoad& load;
  const LoadedState& plate;
  std::vector<LoadedBond> breaks;
};

/// How a breaking at rest ended.
struct Broken {
  std::string outcome;
  std::size_t advances = 0;
  Ledger ledger;
};

/// Breaks bonds at rest: the plate is linear between two of them, so the load factor at which the next ones break is
/// known exactly, and no step can be too long. One bond breaks at a time, and those that are loaded alike (mirror images).
/// `observe` may say why the growth ends.
Broken break_at_rest(const Growth& growth, SeveredPlate& plate, BondCheck& check, const std::function<LoadedState()>& solve,
                     const std::function<std::string(const BondEvent&)>& observe);

}  // namespace fracture
