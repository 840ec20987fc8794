#include "cases/driver/static_solution.hpp"

#include "plate/formulation/formulation.hpp"

namespace cases {

plate::StaticResult static_solution(const Case& c, const plate::Formulation& plate,
                                    const plate::StaticOptions& options) {
  return plate::solve_static(plate, plate.total_load(), c.analysis.static_method(), c.analysis.preconditioner, options);
}

}  // namespace cases
