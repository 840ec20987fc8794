#pragma once

#include <optional>

namespace plate {

/// Bonds over a horizon (Dai et al. 2021), or families of cells (theory.md, "The Galerkin plate").
enum class Formulation { ordinary, galerkin };

/// omega(xi)
enum class Influence { inverse /* horizon / length */, constant /* 1 */ };

/// Share of a neighbour's cell that lies within the horizon.
enum class VolumeCorrection {
  none,           // 1
  linear,         // (horizon + spacing/2 - length) / spacing near the rim
  lattice_fitted  // linear, outermost axis shell scaled so that the lattice is isotropic in bending
};

/// How the parameters follow the family that a point really has.
enum class SurfaceCorrection { none, volume, arbitrary_horizon, position_aware };

/// Constants of a full horizon: integrals over the disc (Dai Eqs. 7-8), or sums over the lattice's full family.
enum class FullHorizon { continuum, lattice };

/// Calibration of b_b in the arbitrary horizon domain: independent of the axes, or Dai's Eq. 35.
enum class TwistMatch { frame_invariant, paper };

/// How the plate is turned into points and bonds.
struct Discretization {
  double spacing = 0;            // [length]
  double horizon_ratio = 3.015;  // horizon / spacing
  Influence influence = Influence::inverse;
  VolumeCorrection volume_correction = VolumeCorrection::linear;
  SurfaceCorrection surface_correction = SurfaceCorrection::position_aware;
  FullHorizon full_horizon = FullHorizon::continuum;
  TwistMatch twist_match = TwistMatch::frame_invariant;

  Formulation formulation = Formulation::ordinary;
  std::optional<double> tip_spacing, hole_spacing;  // galerkin [length]
  double spacing_growth = 0.2;                      // galerkin: of the spacing, per distance from tips and holes

  double horizon() const { return horizon_ratio * spacing; }
};

}  // namespace plate
