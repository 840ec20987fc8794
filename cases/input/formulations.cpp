#include "cases/input/formulations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "cases/input/case_file.hpp"
#include "cases/input/keys.hpp"
#include "geometry/shape/predicates.hpp"
#include "plate/formulations.hpp"
#include "plate/model/membrane.hpp"
#include "post/factors/plate_factors.hpp"

namespace cases {
namespace {

using plate::Feature;

/// The keys of the horizon. horizon_ratio sets the window of displacement_extrapolation in every formulation.
void add_horizon(const plate::Discretization& d, const Reading& reading, std::vector<Asked>& found) {
  const plate::Discretization standard;
  const auto add = [&](const std::string& name, bool is_standard, Feature feature) {
    const std::string key = "discretization." + name;
    const bool refused = !is_standard && feature != Feature::horizon;
    if (!is_standard || reading.given(key)) found.push_back({name, key, feature, refused, "remove it"});
  };
  add("horizon_ratio", d.horizon_ratio == standard.horizon_ratio, Feature::horizon);
  add("influence", d.influence == standard.influence, Feature::influence);
  add("volume_correction", d.volume_correction == standard.volume_correction, Feature::volume_correction);
  add("surface_correction", d.surface_correction == standard.surface_correction, Feature::surface_correction);
  add("full_horizon", d.full_horizon == standard.full_horizon, Feature::full_horizon);
  add("boundary", d.boundary == standard.boundary, Feature::surface_nodes);
  add("twist_match", d.twist_match == standard.twist_match, Feature::twist_match);
}

void add_layers(const std::vector<plate::Support>& supports, std::vector<Asked>& found) {
  for (std::size_t i = 0; i < supports.size(); ++i)
    if (plate::is_layer(supports[i].kind))
      found.push_back({"a layer outside the plate", fmt::format("support[{}].kind", i), Feature::layers, true,
                       "choose \"clamped\", \"simply_supported\" or \"simply_supported_hard\""});
}

void add_hubs(const std::vector<plate::Support>& supports, std::vector<Asked>& found) {
  for (std::size_t i = 0; i < supports.size(); ++i)
    if (supports[i].kind == plate::SupportKind::hub && !supports[i].edges.empty())
      found.push_back({"a hub in a hole", fmt::format("support[{}].edges", i), Feature::hubs_in_holes, true,
                       "choose formulation = \"galerkin\", or give on = { circle = [x, y, radius] } without the hole"});
}

void add_analysis(const Analysis& analysis, std::vector<Asked>& found) {
  using enum plate::Preconditioning;
  const auto wanted = analysis.preconditioner;
  if (wanted == local || wanted == two_level)
    found.push_back({fmt::format("preconditioner = \"{}\"", wanted == local ? "local" : "two_level"),
                     "analysis.preconditioner", Feature::short_horizon, true,
                     "choose \"auto\", \"diagonal\" or \"levels\""});
  if (analysis.precision == Analysis::Precision::mixed)
    found.push_back(
        {"precision = \"mixed\"", "analysis.precision", Feature::single_precision, true, "choose \"double\""});
}

/// Bonds that break one by one, and tips that run through a moving plate.
void add_growth(const Case& content, std::vector<Asked>& found) {
  if (!content.growth) return;
  const auto& growth = *content.growth;
  const auto add = [&](const std::string& words, Feature feature) {
    found.push_back({words, "discretization.formulation", feature, true, "choose \"ordinary\""});
  };
  if (growth.by_bonds()) return add("bonds that break one by one", Feature::breaking_bonds);
  if (content.analysis.kind == Analysis::Kind::dynamic)
    add("growth in motion", Feature::running_tips);
  else if (growth.unstable == fracture::Growth::Unstable::move)
    add("unstable = \"move\"", Feature::running_tips);
}

void add_stretching(const Case& content, std::vector<Asked>& found) {
  const auto add = [&](const char* words, const char* key) {
    found.push_back({words, key, Feature::stretching, true, "choose that or formulation = \"galerkin\""});
  };
  if (content.analysis.nonlinear) add("large deflections", "analysis.nonlinear");
  if (content.faces_touch())
    found.push_back({"contact of crack faces", "cracks.contact", Feature::touching_faces, true,
                     "choose that or formulation = \"galerkin\""});
  if (content.analysis.kind == Analysis::Kind::buckling) add("buckling", "analysis.kind");
  const bool loaded = plate::loaded_in_plane(content);
  if (loaded && content.analysis.kind == Analysis::Kind::frequencies)
    add("frequencies under loads in the plane", "analysis.kind");
  if (loaded && content.moves()) add("motion under loads in the plane", "analysis.kind");
}

void add_loads_in_plane(const plate::Problem& problem, std::vector<Asked>& found) {
  for (std::size_t i = 0; i < problem.loads.size(); ++i)
    if (problem.loads[i].in_plane())
      found.push_back({"loads in the plane", key_of_load(problem, i) + ".kind", Feature::in_plane, true,
                       "choose boundary = \"images\" or formulation = \"galerkin\", or remove it"});
}

void add_section(const plate::Problem& problem, std::vector<Asked>& found) {
  const auto& section = problem.section;
  const std::string remedy = "choose formulation = \"galerkin\", or remove it";
  const auto add = [&](bool asked, const std::string& words, const std::string& key) {
    if (asked) found.push_back({words, key, Feature::sections, true, remedy});
  };
  add_loads_in_plane(problem, found);
  for (std::size_t i = 0; i < problem.springs.size(); ++i)
    if (problem.springs[i].depth.given())
      found.push_back({"cracks through a part of the thickness", fmt::format("spring[{}].depth", i),
                       Feature::part_through, true, remedy});
  if (!problem.stiffeners.empty()) found.push_back({"stiffeners", "stiffener", Feature::stiffeners, true, remedy});
  add(section.orthotropic.has_value(), "an orthotropic section", "section.orthotropic");
  add(!section.plies.empty(), "a section of plies", "section.plies");
  add(!section.regions.empty(), "a section that varies", "section.regions");
  add(section.thickness_factor.given(), "a section that varies", "section.thickness_factor");
  add(section.young_factor.given(), "a section that varies", "section.young_factor");
}

struct RecipeKey {
  const char* table;
  const char* name;
  const char* value;  // as TOML
};

/// Keys of the way of Dai et al. (2021) in an analysis of this kind.
std::vector<RecipeKey> dai2021_keys(const std::optional<std::string>& kind) {
  std::vector<RecipeKey> keys{{"discretization", "formulation", "'ordinary'"},
                              {"discretization", "horizon_ratio", "3.015"},
                              {"discretization", "influence", "'inverse'"},
                              {"discretization", "volume_correction", "'linear'"},
                              {"discretization", "surface_correction", "'arbitrary_horizon'"},
                              {"discretization", "full_horizon", "'continuum'"},
                              {"discretization", "twist_match", "'paper'"},
                              {"discretization", "boundary", "'images'"},
                              {"srif", "methods", "['displacement_extrapolation']"},
                              {"srif", "window_horizons", "2"},
                              {"srif", "rows", "1"}};
  if (kind == "static") keys.push_back({"analysis", "method", "'adr'"});
  if (kind == "dynamic") keys.push_back({"analysis", "method", "'central_difference'"});
  return keys;
}

bool of_horizon(Feature feature) {
  return feature <= Feature::twist_match;
}

}  // namespace

std::vector<Asked> asked(const Case& content, const Reading& reading) {
  std::vector<Asked> found;
  add_horizon(content.discretization, reading, found);
  add_layers(content.supports, found);
  add_hubs(content.supports, found);
  add_analysis(content.analysis, found);
  add_growth(content, found);
  add_stretching(content, found);
  add_section(content, found);
  return found;
}

std::string apply_recipe(toml::table& root, Reading& reading) {
  const auto recipe = root["recipe"].value<std::string>();
  if (recipe != "dai2021") return "";
  const auto place = Value(*root.get("recipe"), "recipe", reading).reading().found().place("recipe") + ", recipe";
  for (const auto* kind : plate::formulations())
    if (root["discretization"]["formulation"].value<std::string>() == kind->name && !kind->offers(Feature::horizon)) {
      reading.report_error("recipe",
                           fmt::format("\"{}\" is a way of bonds, and discretization.formulation = \"{}\" has "
                                       "none: remove one",
                                       *recipe, kind->name));
      return "";
    }
  std::vector<std::string> sets, instead;
  for (const auto& [name, key, value] : dai2021_keys(root["analysis"]["kind"].value<std::string>())) {
    auto* table = root[name].as_table();
    if (!table) continue;
    const auto parsed = toml::parse(fmt::format("value = {}", value));
    const auto words = [&, where = fmt::format("{}.{}", name, key)](const toml::node& node) {
      return fmt::format("{} = {}", where, Value(node, "", reading).toml());
    };
    sets.push_back(words(*parsed.get("value")));
    if (const auto* given = table->get(key); given && words(*given) != sets.back())
      instead.push_back(words(*given));
    else if (!given) {
      table->insert(key, *parsed.get("value"));
      reading.overridden(fmt::format("{}.{}", name, key), place);
    }
  }
  return fmt::format("{}: {}{}{}", *recipe, fmt::join(sets, ", "), instead.empty() ? "" : "; the case has instead ",
                     fmt::join(instead, ", "));
}

bool states_formulation(const toml::table& root) {
  const auto given = root["discretization"]["formulation"].value<std::string>();
  return given && std::ranges::any_of(plate::formulations(), [&](const auto* kind) { return kind->name == *given; });
}

void resolve_formulation(bool stated, Case& content, Reading& reading) {
  const auto& known = plate::formulations();
  content.formulation_reason = "as the case says";
  if (stated) return;
  const auto all = asked(content, reading);
  const auto suits = [&](const auto* kind) {
    return std::ranges::all_of(all, [&](const Asked& one) { return kind->offers(one.feature); });
  };
  const auto found = std::ranges::find_if(known, suits);
  content.discretization.formulation = found == known.end() ? known.back() : *found;
  std::vector<std::string> words;
  for (const auto& one : all)
    if (!known.front()->offers(one.feature) && std::ranges::find(words, one.words) == words.end())
      words.push_back(one.words);
  content.formulation_reason = words.empty() ? "auto: nothing asks for bonds"
                                             : fmt::format("auto: the case asks for {}", fmt::join(words, ", "));
  if (content.discretization.formulation->offers(Feature::graded_points)) return;
  for (const char* name : {"tip_spacing", "hole_spacing", "spacing_growth"})
    if (const auto key = fmt::format("discretization.{}", name); reading.given(key))
      reading.report_error(
          key, fmt::format("is used with formulation = {} only, and bonds are asked for by {}: remove it or that",
                           known.front()->name, fmt::join(words, ", ")));
}

void resolve_grading(Case& content, const Reading& reading) {
  auto& d = content.discretization;
  if (!d.refine_tips || d.tip_spacing || reading.finds_spacing || content.growth || content.moves()) return;
  if (!d.formulation->offers(Feature::graded_points)) return;
  const auto kind = content.analysis.kind;
  if (content.srif && (kind == Analysis::Kind::static_ || kind == Analysis::Kind::harmonic)) {
    d.tip_spacing = post::tip_spacing_for(content);
    if (d.tip_spacing && !reading.given("discretization.spacing_growth")) d.spacing_growth = 0.1;
  }
  if (d.tip_spacing || geometry::singular_corners(content.outline).empty()) return;
  d.tip_spacing = d.spacing;
  const bool in_holes_alone = geometry::reentrant_corners(content.outline.outer.vertices).empty();
  if (in_holes_alone && !reading.given("discretization.spacing_growth"))
    d.spacing_growth = 0.3;  // about twice the points
}

void resolve_method(Case& content, const Reading& reading) {
  auto& analysis = content.analysis;
  const auto& d = content.discretization;
  if (reading.given("analysis.method") || content.growth) return;
  if (analysis.kind == Analysis::Kind::static_ && !plate::formulation_of(d).offers(Feature::symmetry))
    analysis.method = Analysis::Method::direct;
  const bool graded = d.tip_spacing || d.hole_spacing || reading.finds_spacing;
  const auto needs_steps_for = [](const plate::Load& load) {
    return load.as<plate::Settlement>() || load.moves() || load.in_plane();
  };
  const bool needs_steps = content.impact || content.unilateral() || content.faces_touch() || content.coupled() ||
                           analysis.nonlinear || std::ranges::any_of(content.loads, needs_steps_for);
  const bool steps_asked = analysis.time_step || reading.given("analysis.safety") || needs_steps;
  // stiffness damping shortens the stable step a hundred times and more; vectors take none
  const bool damped = analysis.damping && analysis.damping->stiffness > 0 && !reading.distributed &&
                      analysis.precision == Analysis::Precision::double_;
  if (analysis.kind == Analysis::Kind::dynamic && d.formulation->offers(Feature::lanczos) && (graded || damped) &&
      !steps_asked)
    analysis.method = Analysis::Method::lanczos;
}

void check_formulation(const Case& content, Reading& reading) {
  const auto& kind = plate::formulation_of(content.discretization);
  if (const auto& a = content.analysis;
      !kind.offers(Feature::symmetry) &&
      (a.kind != Analysis::Kind::static_ || a.method != Analysis::Method::direct || content.growth))
    reading.report_error("analysis.method", kind.lacks.at(Feature::symmetry) + "; choose method = \"direct\"");
  if (content.analysis.preconditioner == plate::Preconditioning::levels && !kind.offers(Feature::levels))
    reading.report_error("analysis.preconditioner", kind.lacks.at(Feature::levels) +
                                                        "; choose \"auto\", \"diagonal\", \"local\" or \"two_level\"");
  if (content.analysis.method == Analysis::Method::direct && !kind.offers(Feature::factor))
    reading.report_error("analysis.method", kind.lacks.at(Feature::factor) + "; choose \"cg\" or \"adr\"");
  for (const auto& one : asked(content, reading)) {
    if (!one.refused || kind.offers(one.feature)) continue;
    const auto& why = kind.lacks.at(one.feature);
    reading.report_error(
        one.key, of_horizon(one.feature)
                     ? fmt::format("has no meaning with formulation = \"{}\": {}; {}", kind.name, why, one.remedy)
                     : fmt::format("{}; {}", why, one.remedy));
  }
}

CaseFile in_other_formulation(const CaseFile& file) {
  CaseFile result = file;
  Case& c = result.content;
  const auto given = c.discretization;
  c.discretization = {};
  c.discretization.spacing = given.spacing;
  c.discretization.formulation = &plate::other_formulation(*given.formulation);
  if (c.discretization.formulation->offers(Feature::graded_points)) c.discretization.refine_tips = given.refine_tips;
  c.formulation_reason = "the other one of srif.second_formulation";
  c.recipe.clear(), c.recipe_keys.clear();
  c.analysis.preconditioner = plate::Preconditioning::automatic;
  c.analysis.precision = Analysis::Precision::double_;
  if (c.analysis.method == Analysis::Method::lanczos) c.analysis.method = Analysis::Method::central_difference;
  c.output.vtk = c.output.hdf5 = false;
  if (c.srif) c.srif->second_formulation = c.srif->richardson = false;
  c.output.errors = false;

  Reading reading("");
  reading.found().places = file.source.places;
  reading.kind = c.analysis.kind;
  resolve_grading(c, reading);
  check_case(c, reading);
  auto problems = reading.problems();
  for (auto& problem : problems) problem.what = "srif.second_formulation: " + problem.what;
  if (!problems.empty()) throw CaseError(problems);
  return result;
}

}  // namespace cases
