#include "cases/input/refused.hpp"

#include <fmt/format.h>
#include <map>

namespace cases {

std::string key_of(const plate::Refusal& refusal, const plate::Problem& problem) {
  using enum plate::Subject;
  static const std::map<plate::Subject, const char*> keys{{geometry, "geometry"},
                                                          {section, "section"},
                                                          {thickness_factor, "section.thickness_factor"},
                                                          {young_factor, "section.young_factor"},
                                                          {region, "section.regions[{}]"},
                                                          {region_shape, "section.regions[{}].on"},
                                                          {cracks, "geometry.cracks"},
                                                          {crack, "geometry.cracks[{}]"},
                                                          {spacing, "discretization.spacing"},
                                                          {volume_correction, "discretization.volume_correction"},
                                                          {edge_method, "discretization.boundary"},
                                                          {support, "support"},
                                                          {support_points, "support[{}].points"},
                                                          {support_line, "support[{}].along"},
                                                          {support_patch, "support[{}].on"},
                                                          {support_edges, "support[{}].edges"},
                                                          {support_direction, "support[{}].edges"},
                                                          {load_position, "load[{}].position"},
                                                          {load_edges, "load[{}].edges"},
                                                          {load_patch, "load[{}].on"},
                                                          {load_line, "load[{}].along"},
                                                          {load_expression, "load[{}].expression"},
                                                          {settlement, "load[{}].support"},
                                                          {load_table, "load[{}].table"},
                                                          {load_path, "load[{}].path"},
                                                          {foundation, "foundation[{}]"},
                                                          {foundation_patch, "foundation[{}].on"},
                                                          {spring, "spring[{}]"},
                                                          {spring_edges, "spring[{}].edges"},
                                                          {spring_line, "spring[{}].along"},
                                                          {spring_position, "spring[{}].position"},
                                                          {stiffener, "stiffener[{}]"},
                                                          {stiffener_edges, "stiffener[{}].edges"},
                                                          {stiffener_line, "stiffener[{}].along"},
                                                          {preconditioner, "analysis.preconditioner"},
                                                          {precision, "analysis.precision"},
                                                          {modes, "analysis.modes"},
                                                          {time_step, "analysis.time_step"},
                                                          {duration, "analysis.duration"},
                                                          {rows, "output.history_every"},
                                                          {density, "section.density"}};
  const auto key = fmt::format(fmt::runtime(keys.at(refusal.subject)), refusal.number);
  return key.starts_with("load[") ? plate::key_of_load(problem, refusal.number) + key.substr(key.find(']') + 1) : key;
}

std::vector<Problem> problems_of(const CaseFile& file, const std::vector<plate::Refusal>& refusals) {
  std::vector<Problem> problems;
  for (const auto& one : refusals) {
    const auto key = key_of(one, file.content);
    problems.push_back({file.place(key), key, one.what});
  }
  return problems;
}

}  // namespace cases
