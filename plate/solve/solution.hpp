#pragma once
#include <memory>
#include <optional>
#include <string>

#include "plate/model/solver_choices.hpp"
#include "plate/solve/statics.hpp"

namespace plate {

class Formulation;
struct Analysis;

/// The equilibrium of a plate, and how it was found.
struct StaticResult {
  StaticSolution solution;
  std::string method;                         // as in case files
  std::optional<std::string> preconditioner;  // of conjugate gradients
  std::size_t factor_bytes = 0;
  /// The state less a motion of the whole plate with its supports, as one rigid body: what strains it, to more digits
  /// than the state has. Without columns where it is the state.
  State strained = State(3, 0);
  const State& what_strains() const { return strained.cols() > 0 ? strained : solution.state; }
};

/// By a method, and with a preconditioner for conjugate gradients. `lift`: of supports that have moved; without columns
/// none. Throws NumericalError as the solvers do.
StaticResult solve_static(const Formulation& plate, const Forces& load, StaticMethod method, Preconditioning wanted,
                          const StaticOptions& options, const State& lift = State(3, 0));

/// Under all loads, by the method and with the preconditioner of an analysis.
StaticResult static_solution(const Formulation& plate, const Analysis& analysis, const StaticOptions& options);

/// At rest under the loads of time 0; nothing where these are none. Throws NumericalError.
State start_of(const Formulation& plate, const Analysis& analysis);

/// What is nearest to the inverse of a held plate and pays for many loads: its factor, or, where it has many points,
/// its coarser plates. `plate` must outlive it.
std::unique_ptr<Preconditioner> inverse_of(const Formulation& plate);

}  // namespace plate
