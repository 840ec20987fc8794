#pragma once
#include <functional>
#include <memory>
#include "plate/formulation/operator.hpp"

namespace plate {

class Constraints;
class Formulation;
struct Section;

struct FrequencyOptions {
  std::size_t modes = 6;
  double tolerance = 1e-4;                         // of the eigenvectors; errors of omega^2 are of its second order
  std::size_t max_iterations = 200000;             // of conjugate gradients in each solution
  double shift = 0;                                // sigma [1/time^2] > 0; shift_of() gives one that suits the plate
  const Preconditioner* preconditioner = nullptr;  // of K or K + sigma M; absent: the diagonal of K + sigma M
  std::function<void(std::size_t solution)> progress;  // before each solution of (K + sigma M) q = f
};

struct Mode {
  double frequency;  // [1/time]
  double residual;   // |K q - omega^2 M q| / |(omega^2 + sigma) M q|, in the norm of StaticOptions
  State shape;       // u = P q; the largest |w| is 1 and positive
  // of a plate whose bending and stretching are coupled, where the largest of w, u and v is 1:
  State in_plane = {};
  double share_in_plane = 0;  // of the kinetic energy
};

/// The state with the largest |w| of 1, or as it is where nothing but rotations moves. Collective.
State normalized(const Constraints& constraints, State state);

struct FrequencySolution {
  std::vector<Mode> modes;     // ascending
  std::size_t solutions = 0;   // of (K + sigma M) q = f
  std::size_t iterations = 0;  // of conjugate gradients in all of them
};

/// omega^2 of a strip of this length between simple supports, D / (rho h) (pi / length)^4: of the order of a plate's
/// lowest frequency, whatever the units.
double shift_of(const Section& section, double length);

/// The lowest eigenpairs of K q = omega^2 M q on the free degrees of freedom (u = P q): Lanczos iteration with the
/// inverse of K + sigma M. A plate that is not held has its rigid motions among them, with frequencies near zero.
/// `mass` as from mass(). Where the plate is distributed, all of them find the same. Multiple frequencies appear as
/// often as they are. Throws NumericalError where an iteration does not converge or a number is not finite,
/// std::invalid_argument where the plate has too few degrees of freedom or the shift is not positive.
FrequencySolution frequencies(const Operator& plate, const Constraints& constraints, const Forces& mass,
                              const FrequencyOptions& options);

/// Frequencies of a plate under loads in its plane, which stiffen or soften it. `membrane`: the plate in its plane.
/// @throws NumericalError  as frequencies(), and where the plate buckles below these loads
FrequencySolution frequencies_under_load(const Formulation& membrane, const Formulation& plate, const Forces& mass,
                                         const FrequencyOptions& options);

}  // namespace plate
