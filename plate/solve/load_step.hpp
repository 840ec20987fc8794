#pragma once
#include <cstddef>

namespace plate {

/// An equilibrium on the way to the full load.
struct LoadStep {
  double factor = 0;  // of all loads
  std::size_t iterations = 0;
  double residual = 0;            // relative to the load
  double largest_deflection = 0;  // |w| of any point [length]
  double strain_energy = 0;
  bool stable = true;    // the stiffness is positive there
  bool snapped = false;  // on the way from the step before it was not
};

}  // namespace plate
