#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/crack_path.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/numerical_method.hpp"
#include "plate/model/section.hpp"
#include "plate/model/supports.hpp"

namespace plate {

struct Problem;

/// Loads that act together, beside those that all load cases share.
struct LoadCase {
  std::string name;
  std::vector<Load> loads;
};

/// A sum of load cases, each times its factor.
struct Combination {
  std::string name;
  std::vector<std::pair<std::string, double>> of;
};

/// The problem with the loads of all its load cases behind those that they share.
void join_loads(Problem& problem);
/// Gives loads by gravity their value, density thickness gravity [force/length^2]; the first of them where the section
/// has no density.
std::optional<std::size_t> resolve_weights(Problem& problem);
/// Number of loads that all load cases share, after join_loads().
std::size_t shared_loads(const Problem& problem);
/// The loads of a problem, after join_loads(), that act in its load case `which`.
std::vector<std::size_t> loads_of(const Problem& problem, std::size_t which);

/// Factor of each load case in a combination [load cases].
std::vector<double> factors_of(const Combination& combination, const std::vector<LoadCase>& cases);

/// Behaviour of the faces of cracks where they meet.
struct CrackFaces {
  bool contact = false;  // they touch without friction, and do not overlap
};

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
  std::optional<Initial> initial = {};   // of a motion
  std::optional<Impact> impact = {};     // likewise
  bool stretches = false;                // its middle plane, with the deflections (von Karman)
  std::optional<CrackFaces> faces = {};  // of the cracks
  bool joined_with_plane = false;        // states of the plate and its plane stand together: they share all points

  /// True where there is a unilateral foundation.
  bool unilateral() const {
    return std::ranges::any_of(foundations, [](const Foundation& one) { return one.unilateral; });
  }
  /// True where there is a support that only pushes.
  bool pushed() const {
    return std::ranges::any_of(supports, [](const Support& one) { return one.push != Push::both_ways; });
  }
  bool faces_touch() const { return faces && faces->contact; }
  /// True where bending and stretching act on each other in linear theory.
  bool coupled() const {
    return section.couples() || std::ranges::any_of(stiffeners, &Stiffener::eccentric) || part_through();
  }
  /// True where springs tie the faces of cracks.
  bool ties_faces() const {
    return std::ranges::any_of(springs, [](const Spring& one) { return !one.cracks.empty(); });
  }
  /// True where a crack goes through a part of the thickness.
  bool part_through() const {
    return std::ranges::any_of(springs, [](const Spring& one) { return one.depth.given(); });
  }
  bool elastically_supported() const { return !foundations.empty() || !springs.empty(); }
};

/// Supports of the problem with the method of the discretisation resolved: in layers where it says so.
std::vector<Support> resolved_supports(const Problem& problem);

/// Cracks of a problem as paths [length].
std::vector<geometry::CrackPath> crack_paths(const Problem& problem);

}  // namespace plate
