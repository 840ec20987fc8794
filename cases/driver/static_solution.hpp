#pragma once
#include "cases/driver/assembly.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/summary.hpp"

namespace cases {

/// A plate at rest, and how it was found.
struct StaticResult {
  plate::StaticSolution solution;
  std::string method;                         // as in the case file
  std::optional<std::string> preconditioner;  // of conjugate gradients
  std::size_t factor_bytes = 0;
};

/// Memory that a further program could have [bytes]; 0 where the system does not tell.
double free_memory();

/// What a summary says of a solution at rest.
void describe(post::Summary::Analysis& analysis, const std::string& method, const plate::StaticSolution& solution, double tolerance);

/// All loads at their last values together.
plate::Forces total_load(const Assembly& assembly);

/// The Galerkin plate on coarser points (plate::GalerkinLevels), or its factor where it has few points. Held plates only.
/// `assembly` must outlive it.
std::unique_ptr<plate::Preconditioner> galerkin_levels(const Case& c, const Assembly& assembly);

/// What is nearest to the inverse of a held Galerkin plate and pays for many loads: its factor, or its coarser plates where it has many
/// points. `assembly` must outlive it.
std::unique_ptr<plate::Preconditioner> inverse_of(const Case& c, const Assembly& assembly);

/// All loads as they are at time 0.
plate::Forces first_load(const Assembly& assembly);

/// By the method and with the preconditioner of the case (in dynamics conjugate gradients); `options` in place of the case's tolerance and limit.
/// Throws NumericalError as the solvers do.
StaticResult solve_at_rest(const Case& c, const Assembly& assembly, const plate::Forces& load,
                           const plate::StaticOptions& options);
/// Under all loads at their last values.
StaticResult solve_at_rest(const Case& c, const Assembly& assembly, const plate::StaticOptions& options);

}  // namespace cases
