#pragma once
#include <map>
#include <string>

namespace plate {

struct Problem;
struct Discretised;

/// What not every formulation can do.
enum class Feature {
  horizon,    // families within a horizon
  influence,  // a choice of the influence function
  volume_correction,
  surface_correction,
  full_horizon,
  surface_nodes,  // on edges, or another choice of what stands beyond them
  twist_match,
  layers,         // supports by layers outside the plate
  any_direction,  // supports of every kind on edges of any direction
  graded_points,
  short_horizon,  // preconditioners "local" and "two_level"
  levels,         // preconditioner "levels"
  factor,         // the plate itself, factorised
  single_precision,
  lanczos,         // motion by Lanczos vectors
  symmetry,        // of the stiffness: iterations, motion and frequencies
  breaking_bonds,  // bonds that break one by one
  running_tips,    // tips that run while the plate moves
  sections,        // that vary or have directions
  stiffeners       // beams on the plate
};

/// A formulation of the plate, before anything is discretised: what it is called, what it cannot do, and how it turns a
/// problem into a plate that is ready to solve. One constant of each formulation; nothing above asks which one it has.
struct FormulationKind {
  std::string name;                      // as in case files
  std::string words;                     // "the Galerkin plate"
  std::map<Feature, std::string> lacks;  // what it cannot do, and why: the words of refusals
  Discretised (*discretise)(const Problem& problem);

  bool offers(Feature feature) const { return !lacks.contains(feature); }
};

}  // namespace plate
