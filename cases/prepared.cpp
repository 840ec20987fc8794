#include "cases/prepared.hpp"

namespace cases {

Prepared::Prepared(CaseFile wanted) : file(std::move(wanted)), assembly(assemble(file, stopwatch)) {
  const Case& c = file.content;
  if (c.analysis.kind == Analysis::Kind::dynamic) {
    check_growing_tips(file, assembly);
    const double limit = plate::stable_time_step(assembly.plate(), assembly.boundary.constraints, mass_of(c, assembly));
    steps = {limit, time_grid(file, limit)};
    stopwatch.lap("solve");
  }
  tip_methods = cases::tip_methods(file, assembly);
  stopwatch.lap("srif");
}

}  // namespace cases
