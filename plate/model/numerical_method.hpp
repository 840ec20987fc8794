#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plate {

class Communicator;
struct Discretised;
struct FormulationKind;
struct Problem;

/// omega(xi)
enum class Influence { inverse /* horizon / length */, constant /* 1 */ };

/// Share of a neighbour's cell that lies within the horizon.
enum class VolumeCorrection {
  none,           // 1
  linear,         // (horizon + spacing/2 - length) / spacing near the rim
  lattice_fitted  // linear, outermost axis shell scaled so that the lattice is isotropic in bending
};

/// Correction of the parameters for the family that a point really has.
enum class SurfaceCorrection { none, volume, arbitrary_horizon, position_aware };

/// Constants of a full horizon: integrals over the disc (Dai 7-8), or sums over the lattice's full family.
enum class FullHorizon { continuum, lattice };

/// Calibration of b_b in the arbitrary horizon domain: independent of the axes, or Dai 35.
enum class TwistMatch { frame_invariant, paper };

/// Treatment of the region beyond the edges: mirror images and rows that follow where edges are held, the layers of Dai
/// et al. there, surface nodes on all edges (Sca23, for the plate), or nodes whose values are expanded from those
/// inside, with conditions at all edges by Lagrange multipliers (Sca21, for the plate).
enum class EdgeMethod { images, layer, surface_nodes, fictitious_nodes };

/// Edge methods by their names in case files.
inline const std::vector<std::pair<std::string, EdgeMethod>> edge_methods{
    {"images", EdgeMethod::images},
    {"layer", EdgeMethod::layer},
    {"surface_nodes", EdgeMethod::surface_nodes},
    {"fictitious_nodes", EdgeMethod::fictitious_nodes}};

/// Discretisation of the plate into points and bonds.
struct Discretization {
  double spacing = 0;            // [length]
  double horizon_ratio = 3.015;  // horizon / spacing
  Influence influence = Influence::inverse;
  VolumeCorrection volume_correction = VolumeCorrection::linear;
  SurfaceCorrection surface_correction = SurfaceCorrection::position_aware;
  FullHorizon full_horizon = FullHorizon::continuum;
  TwistMatch twist_match = TwistMatch::frame_invariant;
  EdgeMethod boundary = EdgeMethod::images;

  const FormulationKind* formulation = nullptr;     // which one discretises
  std::optional<double> tip_spacing, hole_spacing;  // of graded points [length]
  bool refine_tips = true;                          // graded points where factors need them, without being asked
  double spacing_growth = 0.2;                      // of the spacing of graded points, per distance from tips and holes

  double horizon() const { return horizon_ratio * spacing; }
  /// Spacing about the tips of cracks [length].
  double spacing_at_tips() const { return tip_spacing.value_or(spacing); }
};

/// Capability that not every formulation has.
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
  stiffeners,      // beams on the plate
  in_plane,        // loads and displacements in the plane, at rest
  stretching,      // what couples both: large deflections, buckling; motion, frequencies under loads there
  touching_faces,  // of cracks: contact
  hubs_in_holes,   // rigid discs that fill holes
  part_through     // cracks through a part of the thickness
};

/// A formulation of the plate, before anything is discretised: what it is called, what it cannot do, and how it turns a
/// problem into a plate that is ready to solve. One constant of each formulation; nothing above asks which one it has.
struct FormulationKind {
  std::string name;                      // as in case files
  std::string words;                     // "the Galerkin plate"
  std::map<Feature, std::string> lacks;  // what it cannot do, and why: the words of refusals
  Discretised (*discretise)(const Problem& problem, const Communicator& communicator);

  bool offers(Feature feature) const { return !lacks.contains(feature); }
};

/// Method that finds the equilibrium of a plate.
enum class StaticMethod { adr, cg, direct };

/// Preconditioner of conjugate gradients.
enum class Preconditioning { automatic, diagonal, local, two_level, levels };

/// Rayleigh's damping: forces -C v with C = alpha M + beta K.
struct Damping {
  double mass = 0;       // alpha [1/time]
  double stiffness = 0;  // beta [time]

  bool none() const { return mass == 0 && stiffness == 0; }
};

/// The frequencies of a harmonic analysis.
struct Sweep {
  double from = 0, to = 0;  // [1/time]
  std::size_t count = 100;  // equally far from each other, ends included; with one: `from`

  std::vector<double> frequencies() const;
};

}  // namespace plate
