#include "cases/driver/prepared.hpp"

#include <algorithm>

namespace cases {
namespace {

/// Lanczos vectors need answers at rest: a plate that moves freely takes steps, unless its case states the vectors.
void settle_free_motion(CaseFile& file, const Assembly& assembly) {
  const auto pieces = plate::pieces(assembly.boundary, assembly.families());
  if (!assembly.may_move && std::ranges::none_of(pieces, [](const auto& piece) { return piece.free_modes > 0; })) return;
  if (file.content.srif && file.content.srif->accuracy)
    throw CaseError({{file.place("srif.accuracy"), "srif.accuracy",
                      "in motion needs a plate that supports hold: hold it, or state the discretisation instead"}});
  const bool stated = std::ranges::any_of(file.places, [](const auto& given) { return given.first == "analysis.method"; });
  if (stated)
    throw CaseError({{file.place("analysis.method"), "analysis.method",
                      "\"lanczos\" needs a plate that supports hold; choose \"central_difference\""}});
  file.content.analysis.method = Analysis::Method::central_difference;
}

}  // namespace

Prepared::Prepared(CaseFile wanted) : file(std::move(wanted)), assembly(assemble(file, stopwatch)) {
  const Case& c = file.content;
  if (c.analysis.kind == Analysis::Kind::dynamic) {
    check_growing_tips(file, assembly);
    if (c.analysis.method == Analysis::Method::lanczos) settle_free_motion(file, assembly);
    if (c.analysis.method == Analysis::Method::lanczos) {
      steps = {0, row_grid(file)};
    } else {
      const double limit = plate::stable_time_step(assembly.plate(), assembly.boundary.constraints, mass_of(c, assembly));
      steps = {limit, time_grid(file, limit)};
    }
    stopwatch.lap("solve");
  }
  tip_methods = cases::tip_methods(file, assembly);
  warn_of_ligaments(c, assembly);
  stopwatch.lap("srif");
}

}  // namespace cases
