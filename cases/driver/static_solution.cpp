#include "cases/driver/static_solution.hpp"

namespace cases {

void describe(post::Summary::Analysis& analysis, const std::string& method, const plate::StaticSolution& solution,
              double tolerance) {
  analysis.method = method;
  analysis.iterations = solution.iterations;
  analysis.residual = solution.residual;
  analysis.tolerance = tolerance;
  analysis.stop_reason = solution.stop_reason;
}

plate::StaticResult static_solution(const Case& c, const plate::Formulation& plate,
                                    const plate::StaticOptions& options) {
  return plate::solve_static(plate, plate.total_load(), c.analysis.static_method(), c.analysis.preconditioner, options);
}

}  // namespace cases
