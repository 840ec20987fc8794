#pragma once
#include <functional>
#include <string>
#include "fracture/growth/rest_load.hpp"
#include "fracture/growth/kink.hpp"
#include "geometry/shape/crack_extension.hpp"

namespace fracture {

/// A tip under the whole load.
struct LoadedTip {
  geometry::Tip tip;
  Factors factors{0, 0, 0};
  std::optional<double> G;  // energy release rate of the plate [force]; none: no ring fits about it any more
};

/// The plate with certain cracks under the whole load.
struct LoadedPlate {
  std::string split;    // not empty: a piece of the plate is not held any more, and nothing could be solved
  double displacement = 0;  // sum of loads times displacements at rest [energy]: what the load factor does work on
  std::vector<LoadedTip> tips;
};

/// Solves the plate with these cracks.
using Solve = std::function<LoadedPlate(const std::vector<geometry::Polyline>& cracks)>;

/// One state at rest on the way, just before tips move on.
struct Event {
  std::size_t advance;  // number of it; the first state is 0
  double load_factor, displacement;  // displacement: of the state, load_factor times that of the whole load
  double critical;      // load factor at which the next tip moves; infinite where none can
  bool stable;          // no load that was reached before would have been enough
  Ledger ledger;
  const LoadedPlate& plate;
  const std::vector<geometry::Polyline>& cracks;
  std::vector<char> moves;  // per tip of the plate
};

/// Outcome of a growth that may not jump.
inline const std::string unstable_advance = "the next advance is unstable";

/// How a growth ended, and the cracks then.
struct Grown {
  std::string outcome;
  std::size_t advances = 0;
  Ledger ledger;
  std::vector<geometry::Polyline> cracks;
};

/// Grows the cracks at rest, load by load: the plate is linear between advances, so the load factor at which the next
/// tip moves is known exactly (theory.md, "Growth"). Tips whose energy release rates are within a percent of the
/// largest move together. A tip about which no ring fits breaks through to what is nearest. `spacing`: of the points
/// [length].
Grown grow_at_rest(const Growth& growth, const plate::Section& section, const geometry::Outline& outline,
                   std::vector<geometry::Polyline> cracks, double spacing, const Solve& solve,
                   const std::function<void(const Event&)>& observe);

}  // namespace fracture
