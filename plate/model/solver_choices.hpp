#pragma once
#include <cstddef>
#include <vector>

namespace plate {

/// How the equilibrium of a plate is found.
enum class StaticMethod { adr, cg, direct };

/// How the inverse of the stiffness is approached in conjugate gradients.
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
