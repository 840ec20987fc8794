#include "plate/solve/solution.hpp"

#include <fmt/format.h>

#include "plate/formulation/formulation.hpp"
#include "plate/formulation/preconditioner.hpp"
#include "plate/model/numerical_error.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/reduction.hpp"
#include "plate/solve/settled.hpp"
#include "plate/solve/static_solver.hpp"

namespace plate {

StaticResult solve_static(const Formulation& plate, const Forces& load, StaticMethod method, Preconditioning wanted,
                          const StaticOptions& options, const State& lift) {
  return StaticSolver(plate, method, wanted)(load, options, false, lift);
}

StaticResult static_solution(const Formulation& plate, const Analysis& analysis, const StaticOptions& options) {
  return solve_static(plate, acting_load(plate), analysis.static_method(), analysis.preconditioner, options,
                      total_lift(plate));
}

State start_of(const Formulation& plate, const Analysis& analysis) {
  const auto load = plate.first_load();
  const auto lift = first_lift(plate);
  if (largest_of_all(load.isZero(0) && lift.isZero(0) ? 0 : 1) == 0) return {};
  const auto result = solve_static(plate, load, analysis.static_method(), analysis.preconditioner,
                                   {StaticOptions{}.tolerance, analysis.max_iterations, {}}, lift);
  if (!result.solution.converged)
    throw NumericalError(fmt::format("the plate at the start: {}, residual {:.2e}", result.solution.stop_reason,
                                     result.solution.residual));
  return result.solution.state;
}

std::unique_ptr<Preconditioner> inverse_of(const Formulation& plate) {
  constexpr std::size_t many = 100000;  // points
  if (plate.points() <= many || !plate.offers(Feature::levels)) return plate.factor();
  return plate.preconditioner(Preconditioning::automatic).inverse;
}

}  // namespace plate
