#include "post/studies/runs/read_summary.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

namespace post {
namespace {

using Json = nlohmann::json;

template <class Value>
std::optional<Value> optional(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() || found->is_null() ? std::nullopt : std::optional(found->get<Value>());
}

Srif srif_of(const Json& json) {
  Srif srif;
  srif.tip = json.at("tip");
  srif.position = {json.at("x").get<double>(), json.at("y").get<double>()};
  srif.method = json.at("method");
  const std::array factors{&srif.K1, &srif.K2, &srif.K3};
  const std::array normalized{&srif.F1, &srif.F2, &srif.F3};
  const std::array<const char*, 3> K{"K1", "K2", "K3"}, F{"F1", "F2", "F3"},
      error{"estimated_error_K1", "estimated_error_K2", "estimated_error_K3"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto factor = optional<double>(json, K[i]);
    srif.resolved[i] = factor.has_value();
    *factors[i] = factor.value_or(0);
    *normalized[i] = optional<double>(json, F[i]);
    srif.errors[i] = optional<double>(json, error[i]);
  }
  srif.estimated_error = optional<double>(json, "estimated_error");
  return srif;
}

GrowthSummary growth_of(const Json& json) {
  GrowthSummary growth;
  growth.outcome = json.at("outcome");
  growth.advances = json.at("advances");
  growth.first_load_factor = optional<double>(json, "first_load_factor");
  growth.first_load_factor_error = optional<double>(json, "first_load_factor_error");
  growth.largest_load_factor = optional<double>(json, "largest_load_factor");
  growth.lengths = json.at("lengths").get<std::vector<double>>();
  return growth;
}

Summary summary_of(const Json& json) {
  Summary summary;
  summary.units = json.value("units", ""), summary.title = json.at("title"), summary.outcome = json.at("outcome");
  summary.version = json.at("version"), summary.digest = json.at("digest");
  summary.formulation = json.at("formulation"), summary.formulation_reason = json.value("formulation_reason", "");
  summary.points = json.at("points"), summary.bonds = json.at("bonds");
  summary.analysis.kind = json.at("analysis").at("kind");
  summary.analysis.stop_reason = json.at("analysis").value("stop_reason", "");
  summary.analysis.iterations = optional<std::size_t>(json.at("analysis"), "iterations");
  summary.analysis.steps = optional<std::size_t>(json.at("analysis"), "steps");
  for (const auto& [stage, spent] : json.at("seconds").items()) summary.seconds.emplace_back(stage, spent);
  for (const auto& one : json.at("srif")) summary.srif.push_back(srif_of(one));
  for (const auto& one : json.value("peaks", Json::array()))
    summary.peaks.push_back(
        {one.at("quantity"), optional<std::size_t>(one, "tip"), one.at("value"), one.at("time"), {}, {}});
  for (const auto& one : json.value("frequencies", Json::array()))
    summary.frequencies.push_back({one.at("mode"), one.at("frequency"), one.at("omega"), one.at("residual")});
  if (json.contains("growth")) summary.growth = growth_of(json.at("growth"));
  summary.warnings = json.at("warnings").get<std::vector<std::string>>();
  return summary;
}

}  // namespace

std::optional<Summary> read_summary(const std::filesystem::path& path) {
  std::ifstream file(path);
  const auto json = Json::parse(file, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    return summary_of(json);
  } catch (const Json::exception&) {
    return std::nullopt;  // of another version
  }
}

}  // namespace post
