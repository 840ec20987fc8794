#pragma once
#include <algorithm>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/model/discretization.hpp"
#include "plate/model/elastic/elastic_supports.hpp"
#include "plate/model/loading/load_cases.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/section.hpp"
#include "plate/model/supports.hpp"

namespace plate {

/// A plate with its cracks, how it is held and loaded, and how it is to be turned into points.
struct Problem {
  Section section;
  geometry::Outline outline;
  std::vector<geometry::Polyline> cracks;
  Discretization discretization;
  std::vector<Support> supports;
  std::vector<Load> loads;
  std::vector<Foundation> foundations = {};
  std::vector<Spring> springs = {};
  std::vector<Stiffener> stiffeners = {};
  std::vector<LoadCase> load_cases = {};  // in statics; their loads stand behind the others in `loads` (join_loads)
  std::vector<Combination> combinations = {};
  std::optional<Initial> initial = {};  // of a motion
  std::optional<Impact> impact = {};    // likewise

  /// Is there soil that lets the plate lift off?
  bool lifts_off() const {
    return std::ranges::any_of(foundations, [](const Foundation& one) { return one.lifts_off; });
  }
  bool elastically_held() const { return !foundations.empty() || !springs.empty(); }
};

/// Its supports as the discretisation holds them: in layers where it says so.
std::vector<Support> settled_supports(const Problem& problem);

/// Its cracks as paths [length].
std::vector<geometry::CrackPath> crack_paths(const Problem& problem);

}  // namespace plate
