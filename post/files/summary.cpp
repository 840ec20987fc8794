#include "post/files/summary.hpp"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "plate/solve/statics.hpp"
#include "post/files/table.hpp"

namespace post {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

template <typename Value>
void add(Json& json, const char* name, const std::optional<Value>& value) {
  if (value) json[name] = *value;
}

Json json_of(const Summary::Analysis& analysis) {
  Json json{{"kind", analysis.kind}, {"method", analysis.method}};
  add(json, "preconditioner", analysis.preconditioner);
  add(json, "iterations", analysis.iterations);
  add(json, "steps", analysis.steps);
  add(json, "time_step", analysis.time_step);
  add(json, "time_step_limit", analysis.time_step_limit);
  add(json, "residual", analysis.residual);
  add(json, "tolerance", analysis.tolerance);
  add(json, "duration", analysis.duration);
  json["stop_reason"] = analysis.stop_reason;
  return json;
}

Json json_of(const Srif& srif) {
  Json json{{"tip", srif.tip}, {"x", srif.position.x()}, {"y", srif.position.y()}, {"method", srif.method},
            {"K1", nullptr},   {"K2", nullptr},          {"K3", nullptr}};
  const std::array<const char*, 3> K{"K1", "K2", "K3"}, F{"F1", "F2", "F3"},
      error{"estimated_error_K1", "estimated_error_K2", "estimated_error_K3"};
  const std::array factor{srif.K1, srif.K2, srif.K3};
  const std::array normalized{srif.F1, srif.F2, srif.F3};
  for (std::size_t i = 0; i < 3; ++i)
    if (srif.resolved[i]) json[K[i]] = factor[i];
  for (std::size_t i = 0; i < 3; ++i)
    if (srif.resolved[i]) add(json, F[i], normalized[i]);
  add(json, "estimated_error", srif.estimated_error);
  for (std::size_t i = 0; i < 3; ++i) add(json, error[i], srif.errors[i]);
  add(json, "accuracy_reached", srif.accuracy_reached);
  add(json, "G", srif.G);
  if (const auto& second = srif.second)
    json["second_formulation"] = {{"formulation", second->formulation},
                                  {"method", second->method},
                                  {"K1", second->K1},
                                  {"K2", second->K2},
                                  {"K3", second->K3},
                                  {"difference", second->difference}};
  for (const auto& f : srif.fits)
    json["fits"].push_back({{"inner", f.inner}, {"outer", f.outer}, {"K1", f.K1}, {"K2", f.K2}, {"K3", f.K3}});
  if (srif.rings.empty()) {
    json["fit_residual"] = srif.fit_residual;
    json["samples"] = srif.samples;
    return json;
  }
  for (const auto& r : srif.rings)
    json["rings"].push_back(
        {{"inner", r.inner}, {"outer", r.outer}, {"G", r.G}, {"K1", r.K1}, {"K2", r.K2}, {"K3", r.K3}});
  return json;
}

Json json_of(const Peak& peak) {
  Json json{{"quantity", peak.quantity}};
  add(json, "tip", peak.tip);
  json["value"] = peak.value;
  json["time"] = peak.time;
  return json;
}

Json json_of(const Frequency& frequency) {
  return {{"mode", frequency.mode},
          {"frequency", frequency.frequency},
          {"omega", frequency.omega},
          {"residual", frequency.residual}};
}

Json json_of(const GrowthSummary& growth) {
  Json json{{"outcome", growth.outcome}, {"advances", growth.advances}};
  add(json, "first_load_factor", growth.first_load_factor);
  add(json, "largest_load_factor", growth.largest_load_factor);
  add(json, "spent", growth.spent);
  add(json, "largest_speed", growth.largest_speed);
  add(json, "broken_bonds", growth.broken_bonds);
  json["lengths"] = growth.lengths;
  return json;
}

Json json_of(const AccuracyStep& one) {
  Json json{{"points", one.points}, {"spacing", one.spacing}, {"tip_spacing", one.tip_spacing}};
  add(json, "hole_spacing", one.hole_spacing);
  json["spacing_growth"] = one.spacing_growth;
  json["seconds"] = one.seconds;
  add(json, "estimated_error", one.error);
  return json;
}

Json json_of(const ScenePart& part) {
  return {{"name", part.name}, {"bytes_per_point", part.bytes_per_point}, {"time_share", part.time_share}};
}

Json json_of(const std::vector<std::pair<std::string, double>>& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = value;
  return json;
}

template <typename Element>
Json list_of(const std::vector<Element>& elements) {
  Json json = Json::array();
  for (const Element& element : elements) json.push_back(json_of(element));
  return json;
}

Json json_of(const AccuracySummary& accuracy) {
  Json json{{"asked", accuracy.asked}};
  add(json, "reached", accuracy.reached);
  json["outcome"] = accuracy.outcome;
  json["path"] = list_of(accuracy.path);
  return json;
}

}  // namespace

void describe(Summary::Analysis& analysis, const std::string& method, const plate::StaticSolution& solution,
              double tolerance) {
  analysis.method = method;
  analysis.iterations = solution.iterations;
  analysis.residual = solution.residual;
  analysis.tolerance = tolerance;
  analysis.stop_reason = solution.stop_reason;
}

std::string to_json(const Summary& summary) {
  Json json;
  json["title"] = summary.title;
  json["outcome"] = summary.outcome;
  json["formulation"] = summary.formulation;
  json["formulation_reason"] = summary.formulation_reason;
  json["points"] = summary.points;
  json["bonds"] = summary.bonds;
  json["fictitious_points"] = summary.fictitious_points;
  json["fictitious_bonds"] = summary.fictitious_bonds;
  json["spacing"] = summary.spacing;
  json["horizon"] = summary.horizon;
  if (const auto& matched = summary.position_aware)
    json["position_aware"] = {
        {"exact", matched->exact}, {"blended", matched->blended}, {"arbitrary_horizon", matched->arbitrary_horizon}};
  json["analysis"] = json_of(summary.analysis);
  json["seconds"] = json_of(summary.seconds);
  json["peak_memory_bytes"] = summary.peak_memory_bytes;
  json["srif"] = list_of(summary.srif);
  if (!summary.peaks.empty()) json["peaks"] = list_of(summary.peaks);
  if (summary.accuracy) json["accuracy"] = json_of(*summary.accuracy);
  if (summary.analysis.kind == "frequencies") json["frequencies"] = list_of(summary.frequencies);
  if (summary.growth) json["growth"] = json_of(*summary.growth);
  json["energy"] = json_of(summary.energy);
  json["scene"] = list_of(summary.scene);
  json["warnings"] = summary.warnings;
  json["version"] = summary.version;
  json["digest"] = summary.digest;
  constexpr int indent = 2;
  // a title that is not UTF-8 is no reason to lose the results: its odd bytes are replaced
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::size_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::size_t bytes_per_kib = 1024;  // Linux counts ru_maxrss in KiB
  return static_cast<std::size_t>(usage.ru_maxrss) * bytes_per_kib;
}

}  // namespace post
