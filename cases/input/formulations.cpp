#include "cases/input/formulations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace cases {
namespace {

using plate::Formulation;

/// The keys of the horizon. horizon_ratio sets the window of displacement_extrapolation in the Galerkin plate.
void add_horizon(const plate::Discretization& d, const Reading& reading, std::vector<OfBonds>& found) {
  const plate::Discretization standard;
  const auto add = [&](const std::string& name, bool is_standard, const std::string& why) {
    const std::string key = "discretization." + name;
    if (is_standard && !reading.given(key)) return;
    const bool refused = !is_standard && !why.empty();
    found.push_back(
        {name, key, refused ? "has no meaning with formulation = \"galerkin\": " + why + "; remove it" : ""});
  };
  add("horizon_ratio", d.horizon_ratio == standard.horizon_ratio, "");
  add("influence", d.influence == standard.influence, "its families are the points of the cells about a point");
  add("volume_correction", d.volume_correction == standard.volume_correction, "its families end at whole cells");
  add("surface_correction", d.surface_correction == standard.surface_correction,
      "points lie on edges and cracks, nothing is to be corrected there");
  add("full_horizon", d.full_horizon == standard.full_horizon, "its families need no calibration");
  add("twist_match", d.twist_match == standard.twist_match, "its families need no calibration");
}

void add_layers(const std::vector<plate::Support>& supports, std::vector<OfBonds>& found) {
  for (std::size_t i = 0; i < supports.size(); ++i)
    if (is_layer(supports[i].kind))
      found.push_back(
          {"a layer outside the plate", fmt::format("support[{}].kind", i),
           "a layer outside the plate has no meaning with formulation = \"galerkin\", whose points lie on the "
           "edges; choose \"clamped\", \"simply_supported\" or \"simply_supported_hard\""});
}

void add_analysis(const Analysis& analysis, std::vector<OfBonds>& found) {
  using enum Analysis::Preconditioner;
  const auto wanted = analysis.preconditioner;
  if (wanted == local || wanted == two_level)
    found.push_back(
        {fmt::format("preconditioner = \"{}\"", wanted == local ? "local" : "two_level"), "analysis.preconditioner",
         "the plate with a short horizon is of formulation = \"ordinary\"; choose \"auto\", \"diagonal\" or "
         "\"levels\""});
  if (analysis.precision == Analysis::Precision::mixed)
    found.push_back({"precision = \"mixed\"", "analysis.precision",
                     "\"mixed\" is of formulation = \"ordinary\"; choose \"double\""});
}

/// Bonds that break one by one, and tips that run through a moving plate, do so in families over a horizon.
void add_growth(const Case& content, std::vector<OfBonds>& found) {
  if (!content.growth) return;
  const auto& growth = *content.growth;
  const bool dynamic = content.analysis.kind == Analysis::Kind::dynamic;
  const auto add = [&](const std::string& asked, const std::string& why) {
    found.push_back({asked, "discretization.formulation", why + " bonds over a horizon; choose \"ordinary\""});
  };
  if (growth.by_bonds()) return add("bonds that break one by one", "bonds that break one by one are");
  if (dynamic) add("growth in motion", "growth in motion severs");
  if (!dynamic && growth.unstable == fracture::Growth::Unstable::move)
    add("unstable = \"move\"", "growth in motion severs");
}

}  // namespace

bool is_layer(plate::SupportKind kind) {
  using enum plate::SupportKind;
  return kind == clamped_layer || kind == simply_supported_layer || kind == simply_supported_hard_layer;
}

std::string formulation_name(Formulation formulation) {
  return formulation == Formulation::ordinary ? "ordinary" : "galerkin";
}

std::vector<OfBonds> of_bonds(const Case& content, const Reading& reading) {
  std::vector<OfBonds> found;
  add_horizon(content.discretization, reading, found);
  add_layers(content.supports, found);
  add_analysis(content.analysis, found);
  add_growth(content, found);
  return found;
}

bool states_formulation(const toml::table& root) {
  const auto given = root["discretization"]["formulation"].value<std::string>();
  return given == formulation_name(Formulation::ordinary) || given == formulation_name(Formulation::galerkin);
}

void settle_formulation(bool stated, Case& content, Reading& reading) {
  content.formulation_reason = "as the case says";
  if (stated) return;
  std::vector<std::string> asked;
  for (const auto& one : of_bonds(content, reading))
    if (std::ranges::find(asked, one.asked) == asked.end()) asked.push_back(one.asked);
  content.discretization.formulation = asked.empty() ? Formulation::galerkin : Formulation::ordinary;
  content.formulation_reason = asked.empty() ? "auto: nothing asks for bonds"
                                             : fmt::format("auto: the case asks for {}", fmt::join(asked, ", "));
  for (const char* name : {"tip_spacing", "hole_spacing", "spacing_growth"})
    if (const auto key = fmt::format("discretization.{}", name); !asked.empty() && reading.given(key))
      reading.complain(
          key, fmt::format("is used with formulation = galerkin only, and bonds are asked for by {}: remove it or that",
                           fmt::join(asked, ", ")));
}

void settle_method(Case& content, const Reading& reading) {
  auto& analysis = content.analysis;
  if (analysis.kind != Analysis::Kind::dynamic || reading.given("analysis.method") || content.growth) return;
  const auto& d = content.discretization;
  const bool steps_asked = analysis.time_step || reading.given("analysis.safety");
  if (d.formulation == Formulation::galerkin && (d.tip_spacing || d.hole_spacing || reading.finds_spacing) && !steps_asked)
    analysis.method = Analysis::Method::lanczos;
}

void check_formulation(const Case& content, Reading& reading) {
  if (content.discretization.formulation == Formulation::ordinary) {
    if (content.analysis.preconditioner == Analysis::Preconditioner::levels)
      reading.complain(
          "analysis.preconditioner",
          "\"levels\" is of formulation = \"galerkin\"; choose \"auto\", \"diagonal\", \"local\" or \"two_level\"");
    return;
  }
  for (const auto& one : of_bonds(content, reading))
    if (!one.refusal.empty()) reading.complain(one.key, one.refusal);
}

}  // namespace cases
