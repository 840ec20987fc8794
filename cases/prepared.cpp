#include "cases/prepared.hpp"

#include <algorithm>

namespace cases {
namespace {

/// Lanczos vectors need answers at rest.
void check_held_in_motion(const CaseFile& file, const Assembly& assembly) {
  const auto pieces = plate::pieces(assembly.boundary, assembly.families());
  if (std::ranges::any_of(pieces, [](const auto& piece) { return piece.free_modes > 0; }) || assembly.may_move)
    throw CaseError({{file.place("analysis.method"), "analysis.method",
                      "\"lanczos\" needs a plate that supports hold; choose \"central_difference\""}});
}

}  // namespace

Prepared::Prepared(CaseFile wanted) : file(std::move(wanted)), assembly(assemble(file, stopwatch)) {
  const Case& c = file.content;
  if (c.analysis.kind == Analysis::Kind::dynamic) {
    check_growing_tips(file, assembly);
    if (c.analysis.method == Analysis::Method::lanczos) {
      check_held_in_motion(file, assembly);
      steps = {0, row_grid(file)};
    } else {
      const double limit = plate::stable_time_step(assembly.plate(), assembly.boundary.constraints, mass_of(c, assembly));
      steps = {limit, time_grid(file, limit)};
    }
    stopwatch.lap("solve");
  }
  tip_methods = cases::tip_methods(file, assembly);
  stopwatch.lap("srif");
}

}  // namespace cases
