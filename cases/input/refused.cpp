#include "cases/input/refused.hpp"

#include <fmt/format.h>
#include <map>

namespace cases {

std::string key_of(const plate::Refusal& refusal) {
  using enum plate::Subject;
  static const std::map<plate::Subject, const char*> keys{{geometry, "geometry"},
                                                          {cracks, "geometry.cracks"},
                                                          {spacing, "discretization.spacing"},
                                                          {volume_correction, "discretization.volume_correction"},
                                                          {edge_method, "discretization.boundary"},
                                                          {support, "support"},
                                                          {support_points, "support[{}].points"},
                                                          {support_edges, "support[{}].edges"},
                                                          {support_direction, "support[{}].edges"},
                                                          {load_position, "load[{}].position"},
                                                          {load_edges, "load[{}].edges"},
                                                          {load_patch, "load[{}].on"},
                                                          {load_line, "load[{}].along"},
                                                          {foundation, "foundation[{}]"},
                                                          {foundation_patch, "foundation[{}].on"},
                                                          {spring, "spring[{}]"},
                                                          {spring_edges, "spring[{}].edges"},
                                                          {spring_line, "spring[{}].along"},
                                                          {spring_position, "spring[{}].position"},
                                                          {preconditioner, "analysis.preconditioner"},
                                                          {precision, "analysis.precision"},
                                                          {modes, "analysis.modes"},
                                                          {time_step, "analysis.time_step"},
                                                          {duration, "analysis.duration"},
                                                          {rows, "output.history_every"},
                                                          {density, "section.density"}};
  return fmt::format(fmt::runtime(keys.at(refusal.subject)), refusal.number);
}

std::vector<Problem> problems_of(const CaseFile& file, const std::vector<plate::Refusal>& refusals) {
  std::vector<Problem> problems;
  for (const auto& one : refusals) problems.push_back({file.place(key_of(one)), key_of(one), one.what});
  return problems;
}

}  // namespace cases
