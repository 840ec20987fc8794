#include "cases/input/refused.hpp"

#include <fmt/format.h>

namespace cases {

std::string key_of(const plate::Refusal& refusal) {
  using enum plate::Subject;
  switch (refusal.subject) {
    case geometry:
      return "geometry";
    case cracks:
      return "geometry.cracks";
    case spacing:
      return "discretization.spacing";
    case volume_correction:
      return "discretization.volume_correction";
    case support:
      return "support";
    case support_points:
      return fmt::format("support[{}].points", refusal.number);
    case support_edges:
    case support_direction:
      return fmt::format("support[{}].edges", refusal.number);
    case load_position:
      return fmt::format("load[{}].position", refusal.number);
    case load_edges:
      return fmt::format("load[{}].edges", refusal.number);
    case preconditioner:
      return "analysis.preconditioner";
    case precision:
      return "analysis.precision";
    case modes:
      return "analysis.modes";
    case time_step:
      return "analysis.time_step";
    case duration:
      return "analysis.duration";
    case rows:
      return "output.history_every";
    case density:
      return "section.density";
  }
  return "";
}

std::vector<Problem> problems_of(const CaseFile& file, const std::vector<plate::Refusal>& refusals) {
  std::vector<Problem> problems;
  for (const auto& one : refusals) problems.push_back({file.place(key_of(one)), key_of(one), one.what});
  return problems;
}

}  // namespace cases
