#pragma once
#include "cases/input/case.hpp"
#include "plate/solve/solution.hpp"

namespace cases {

/// Under all loads at their last values, by the method and with the preconditioner of the case; `options` in place of
/// the case's tolerance and limit. Throws NumericalError as the solvers do.
plate::StaticResult static_solution(const Case& c, const plate::Formulation& plate,
                                    const plate::StaticOptions& options);

}  // namespace cases
