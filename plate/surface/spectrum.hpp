#pragma once
#include "plate/surface/surface_plate.hpp"

namespace plate {

/// Of the squares of the frequencies, lambda = omega^2, of a plate with surface nodes.
struct EdgeSpectrum {
  double lowest;     // real part of lambda, over the largest |lambda|; below 0: a motion that grows
  double asymmetry;  // largest |Im omega| over the largest |omega|: 0 in a symmetric plate
  int negative;      // how many real parts are below 0, but for rounding
};

/// Surface nodes follow without mass: what is free of them is eliminated, what is held is 0. All eigenvalues of a dense
/// matrix: for plates of some hundred points. It says whether conditions at edges are sound before anything iterates or
/// marches on them.
EdgeSpectrum spectrum(const SurfacePlate& plate, const EdgeConditions& edges, double thickness);

}  // namespace plate
