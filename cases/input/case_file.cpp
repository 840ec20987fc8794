#include "cases/input/case_file.hpp"

#include <fmt/format.h>

#include "cases/input/formulations.hpp"
#include "cases/input/keys.hpp"
#include "cases/input/mirrored_case.hpp"
#include "plate/formulations.hpp"
#include "plate/model/membrane.hpp"
#include "post/report/accuracy_search.hpp"

namespace cases {
namespace {

/// analysis.kind decides about other keys: it is needed before they are read.
std::optional<Analysis::Kind> kind_of(const toml::table& root) {
  const auto given = root["analysis"]["kind"].value<std::string>();
  for (const auto& [name, kind] : analysis_kinds().allowed)
    if (given == name) return kind;
  return std::nullopt;
}

/// Entries of a list or table; of a list of lists those of the inner ones.
std::size_t entries(const toml::node* node) {
  if (const auto* table = node ? node->as_table() : nullptr) return table->size();
  const auto* list = node ? node->as_array() : nullptr;
  std::size_t count = 0;
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const auto* inner = (*list)[i].as_array();
    const auto* polygon = (*list)[i].is_table() ? (*list)[i].as_table()->get_as<toml::array>("polygon") : nullptr;
    count += polygon ? polygon->size() : inner && !inner->empty() && (*inner)[0].is_array() ? inner->size() : 1;
  }
  return count;
}

/// Problems of lists that are too long: checks in pairs, or among all keys, take seconds for this many entries.
std::vector<Problem> too_many(const toml::table& root, const std::string& file) {
  constexpr std::size_t most = 10000;
  std::vector<Problem> problems;
  for (const std::string key : {"geometry.outline.polygon", "geometry.holes", "geometry.cracks", "output.probes",
                                "output.lines", "support", "load", "case", "combination", "foundation", "spring"})
    if (const auto count = entries(root.at_path(key).node()); count > most)
      problems.push_back({file, key, fmt::format("{} points or entries, must be at most {}", count, most)});
  return problems;
}

/// Distance from singular places, the same with all points: the thickness, but no less than what points can resolve.
double distance_of_stress(const Case& content) {
  constexpr double least = 0.05;  // of the smaller side
  const auto [low, high] = geometry::bounding_box(content.outline);
  return std::max(content.section.thickness, least * (high - low).minCoeff());
}

CaseFile case_of(toml::table root, const std::filesystem::path& path, const std::vector<std::string>& overrides,
                 bool distributed) {
  Reading reading(path.string());
  reading.distributed = distributed;
  for (const auto& setting : overrides) apply_override(root, setting, reading);
  auto recipe_keys = apply_recipe(root, reading);
  if (const auto problems = too_many(root, path.string()); !problems.empty()) throw CaseError(problems);
  reading.kind = kind_of(root);
  reading.finds_spacing = bool(root["srif"]["accuracy"]) || root["accuracy"].is_table();
  reading.metres = root["units"].value<std::string>() == "SI";
  reading.spacing = root["discretization"]["spacing"].value<double>();

  Case content;
  content.title = path.stem().string();
  content.recipe_keys = std::move(recipe_keys);
  content.discretization.formulation = plate::formulations().front();  // unless the file states another
  read_fields(case_fields(), Value(root, "", reading), content);
  plate::join_loads(content);
  if (const auto without = plate::resolve_weights(content); without && reading.sound("section.density"))
    reading.report_error(
        "section.density",
        fmt::format("is missing, must be a number > 0: {} is the plate's own weight", key_of_load(content, *without)));
  content.stretches = content.analysis.nonlinear;
  content.joined_with_plane =
      content.stretches || plate::rests_with_plane(content) ||
      (content.analysis.kind != Analysis::Kind::static_ && (plate::loaded_in_plane(content) || content.faces_touch()));
  add_images(content, reading);
  snap_cracks(content, reading);
  resolve_formulation(states_formulation(root), content, reading);
  resolve_method(content, reading);
  check_case(content, reading);
  if (!reading.problems().empty()) throw CaseError(reading.problems());
  merge_cracks(content, reading);
  smooth_cracks(content, reading);
  resolve_grading(content, reading);
  look_at_proportions(content, reading);
  if (content.srif && content.srif->accuracy)
    content.discretization = post::discretization_of(content, content.analysis.kind == Analysis::Kind::dynamic, 1);
  if (content.accuracy) {
    if (content.accuracy->stress && !content.output.stress_distance)
      content.output.stress_distance = distance_of_stress(content);
    content.discretization = post::discretization_for_results(content, 1);
  }
  return {std::move(content), reading.found()};
}

}  // namespace

CaseFile read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides, bool distributed) {
  return case_of(parsed(path, "run"), path, overrides, distributed);
}

CaseFile read_case_text(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  return case_of(parsed_text(text, name), name, overrides, false);
}

std::string resolved_toml(const Case& content) {
  return write_fields(case_fields(), content, content.analysis.kind, "\n") + "\n";
}

std::string key_of_load(const plate::Problem& problem, std::size_t load) {
  const auto shared = plate::shared_loads(problem);
  if (load < shared) return fmt::format("load[{}]", load);
  load -= shared;
  for (std::size_t i = 0; i < problem.load_cases.size(); ++i) {
    const auto own = problem.load_cases[i].loads.size();
    if (load < own) return fmt::format("case[{}].load[{}]", i, load);
    load -= own;
  }
  return "load";
}

std::string key_of(const plate::Refusal& refusal, const plate::Problem& problem) {
  using enum plate::Subject;
  static const std::map<plate::Subject, const char*> keys{{geometry, "geometry"},
                                                          {section, "section"},
                                                          {thickness_factor, "section.thickness_factor"},
                                                          {young_factor, "section.young_factor"},
                                                          {thermal_expansion, "section.thermal_expansion"},
                                                          {region, "section.regions[{}]"},
                                                          {region_shape, "section.regions[{}].on"},
                                                          {cracks, "geometry.cracks"},
                                                          {crack, "geometry.cracks[{}]"},
                                                          {spacing, "discretization.spacing"},
                                                          {volume_correction, "discretization.volume_correction"},
                                                          {surface_correction, "discretization.surface_correction"},
                                                          {edge_method, "discretization.boundary"},
                                                          {support, "support"},
                                                          {support_kind, "support[{}].kind"},
                                                          {support_points, "support[{}].points"},
                                                          {support_in_plane, "support[{}].in_plane"},
                                                          {support_line, "support[{}].along"},
                                                          {support_patch, "support[{}].on"},
                                                          {support_edges, "support[{}].edges"},
                                                          {support_direction, "support[{}].edges"},
                                                          {load_position, "load[{}].position"},
                                                          {load_edges, "load[{}].edges"},
                                                          {load_patch, "load[{}].on"},
                                                          {load_line, "load[{}].along"},
                                                          {load_expression, "load[{}].expression"},
                                                          {load_mean, "load[{}].mean"},
                                                          {settlement, "load[{}].support"},
                                                          {load_table, "load[{}].table"},
                                                          {load_path, "load[{}].path"},
                                                          {foundation, "foundation[{}]"},
                                                          {foundation_patch, "foundation[{}].on"},
                                                          {spring, "spring[{}]"},
                                                          {spring_edges, "spring[{}].edges"},
                                                          {spring_line, "spring[{}].along"},
                                                          {spring_position, "spring[{}].position"},
                                                          {spring_cracks, "spring[{}].cracks"},
                                                          {spring_depth, "spring[{}].depth"},
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
  return key.starts_with("load[") ? key_of_load(problem, refusal.number) + key.substr(key.find(']') + 1) : key;
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
