#pragma once
#include <functional>
#include <optional>
#include <string>
#include "plate/formulation/operator.hpp"

namespace plate {

class Constraints;
class Preconditioner;

/// When a static solution is good enough. The residual is |r| / |load| with |r|^2 = sum r_i^2 / K_ii over the free
/// degrees of freedom (K_ii of P^T diag(K) P): forces and couples count by the displacement that they cause, whatever
/// the units.
struct StaticOptions {
  double tolerance = 1e-6;
  std::size_t max_iterations = 200000;
  std::function<void(std::size_t iteration, double residual)> progress;  // now and then
  std::optional<State> start_of_bound = {};  // of relaxation: where its bound of frequencies is sought from
};

struct StaticSolution {
  State state;
  std::size_t iterations = 0;
  double residual = 0;
  bool converged = false;
  std::string stop_reason;
};

/// Adaptive dynamic relaxation (Dai 14-20; Underwood 1983): time step 1, fictitious mass from a bound on
/// the row sums, damping from the lowest frequency that the motion shows.
/// Throws NumericalError where a number is not finite.
StaticSolution adaptive_dynamic_relaxation(const Operator& plate, const Constraints& constraints, const Forces& load,
                                           const StaticOptions& options);

/// Conjugate gradients on the same operator, preconditioned by its diagonal or by what is given. `start`: where they
/// begin, nothing elsewhere.
/// Throws NumericalError where a number is not finite or the stiffness turns out not to be positive.
StaticSolution conjugate_gradients(const Operator& plate, const Constraints& constraints, const Forces& load,
                                   const StaticOptions& options, const Preconditioner* preconditioner = nullptr,
                                   const State* start = nullptr);

/// The same for the stiffness K + diag(shift), shift >= 0 and zero at held degrees of freedom [3 x points].
StaticSolution conjugate_gradients(const Operator& plate, const Constraints& constraints, const Forces& shift,
                                   const Forces& load, const StaticOptions& options,
                                   const Preconditioner* preconditioner = nullptr);

/// The solution by an exact inverse, improved until it is good enough; of any stiffness, symmetric or not.
/// Throws NumericalError where a number is not finite.
StaticSolution refined(const Operator& plate, const Constraints& constraints, const Forces& load,
                       const StaticOptions& options, const Preconditioner& inverse);

}  // namespace plate
