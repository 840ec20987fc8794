// Which parts of a case go together: the table, tried pair by pair.
#include "cases/input/compatibility.hpp"

#include <map>
#include <set>
#include <sstream>

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;
using cases::Part;

namespace {

using enum cases::Part;

/// Settings that ask for a part, and a load beside the pressure.
struct Sample {
  Part part;
  std::map<std::string, std::string> settings;
  std::string load = {};
};

using Settings = std::map<std::string, std::string>;

Settings joined(Settings one, const Settings& more) {
  one.insert(more.begin(), more.end());
  return one;
}

Settings hub_with(const std::string& more) {
  const std::string hub = "{ kind = 'hub', on = { circle = [0.6, 0.6, 0.2] }" + more + " }";
  return {{"support", "[{ kind = 'clamped', edges = ['left'] }, " + hub + "]"}};
}

std::vector<Sample> samples() {
  const Settings moving{{"analysis.kind", "dynamic"}, {"analysis.duration", "0.5"}, {"section.density", "1"}};
  const Settings grows{{"growth.fracture_energy", "1"}};
  const Settings bonds =
      joined(grows, {{"growth.criterion", "bond_energy"}, {"discretization.formulation", "ordinary"}});
  const std::string traction = "{ kind = 'edge_traction', edges = ['right'], value = 1 }";
  const auto motion_with = [&](const Settings& more) { return joined(moving, more); };
  return {
      {motion, moving},
      {frequencies, {{"analysis.kind", "frequencies"}, {"analysis.modes", "2"}, {"section.density", "1"}}},
      {harmonic,
       {{"analysis.kind", "harmonic"},
        {"analysis.sweep", "{ from = 1, to = 2 }"},
        {"analysis.damping", "{ mass = 1 }"},
        {"discretization.formulation", "galerkin"},
        {"section.density", "1"}}},
      {lanczos, motion_with({{"analysis.method", "lanczos"}, {"discretization.formulation", "galerkin"}})},
      {single_precision, motion_with({{"analysis.precision", "mixed"}, {"discretization.formulation", "ordinary"}})},
      {equilibrium_start, motion_with({{"analysis.start", "equilibrium"}})},
      {initial_deflection, motion_with({{"initial.deflection", "\"0.01*(x+1)^2\""}})},
      {impact, motion_with({{"impact", "{ position = [0.5, 0.5], mass = 1, velocity = 1, stiffness = 1 }"}})},
      {stiffness_damping,
       motion_with({{"analysis.damping", "{ stiffness = 0.1 }"}, {"analysis.method", "central_difference"}})},
      {settlement, {}, "{ kind = 'settlement', support = 0, value = 0.01 }"},
      {moving_load, moving,
       "{ kind = 'point_force', value = 1, path = [[0.5, 0.3], [0.5, 0.8]], speed = 1, history = 'ramp', rise_time = "
       "0.1 }"},
      {load_in_plane, {}, traction},
      {large_deflections, {{"analysis.nonlinear", "true"}, {"discretization.formulation", "galerkin"}}},
      {large_deflections_in_motion,
       motion_with({{"analysis.nonlinear", "true"}, {"discretization.formulation", "galerkin"}})},
      {touching_faces, {{"cracks.contact", "true"}, {"discretization.formulation", "galerkin"}}},
      {touching_in_motion, motion_with({{"cracks.contact", "true"}, {"discretization.formulation", "galerkin"}})},
      {touching_bonds, {{"cracks.contact", "true"}, {"discretization.formulation", "ordinary"}}},
      {buckling, {{"analysis.kind", "buckling"}, {"discretization.formulation", "galerkin"}}, traction},
      {pushing_supports, {{"support", "[{ kind = 'simply_supported', edges = ['left'], pushes = 'up' }]"}}},
      {unilateral_foundation, {{"foundation", "[{ modulus = 1, lifts_off = true }]"}}},
      {temperature, {{"section.thermal_expansion", "1e-5"}}, "{ kind = 'temperature', value = 1 }"},
      {mean_temperature, {{"section.thermal_expansion", "1e-5"}}, "{ kind = 'temperature', mean = 1 }"},
      {load_cases, {{"case", "[{ name = 'a', load = [{ kind = 'pressure', value = 1 }] }]"}}},
      {combinations,
       {{"case", "[{ name = 'a', load = [{ kind = 'pressure', value = 1 }] }]"},
        {"combination", "[{ name = 'b', of = { a = 2 } }]"}}},
      {varied_section,
       {{"section.regions", "[{ on = { circle = [0.6, 0.6, 0.2] }, thickness = 0.2 }]"},
        {"discretization.formulation", "galerkin"}}},
      {factors_to_accuracy, {{"srif.accuracy", "0.01"}, {"discretization.formulation", "galerkin"}}},
      {richardson, {{"srif.richardson", "true"}}},
      {second_formulation, {{"srif.second_formulation", "true"}}},
      {toughness, {{"srif.toughness", "1"}}},
      {growth, grows},
      {growth_of_bonds, bonds},
      {growth_by_displacement, joined(grows, {{"growth.control", "displacement"}})},
      {growth_from_rest_to_motion,
       joined(grows, {{"growth.unstable", "move"}, {"growth.duration", "1"}, {"section.density", "1"}})},
      {frozen_pieces, joined(moving, joined(bonds, {{"growth.fallen", "freeze"}}))},
      {local_preconditioner, {{"analysis.preconditioner", "local"}, {"discretization.formulation", "ordinary"}}},
      {processes, {}},
  };
}

std::vector<Sample> samples_in_plane() {
  const std::string traction = "{ kind = 'edge_traction', edges = ['right'], value = 1 }";
  const Settings grows{{"growth.fracture_energy", "1"}, {"discretization.formulation", "galerkin"}};
  const Settings bends{{"analysis.nonlinear", "true"}, {"discretization.formulation", "galerkin"}};
  return {{arc_length, joined(bends, {{"analysis.control", "arc_length"}})},
          {constant_load, bends, "{ kind = 'pressure', value = 1, constant = true }"},
          {growth_in_plane, grows, traction},
          {results_to_accuracy, {{"accuracy.deflection", "0.01"}}}};
}

std::vector<Sample> samples_of_supports() {
  return {
      {layers,
       {{"support", "[{ kind = 'clamped_layer', edges = ['left'] }]"}, {"discretization.formulation", "ordinary"}}},
      {hubs, hub_with("")},
      {hubs_on_springs, hub_with(", k_w = 1")},
      {nodes_on_edges, {{"discretization.boundary", "surface_nodes"}, {"discretization.formulation", "ordinary"}}},
      {springs_on_cracks, {{"spring", "[{ cracks = [0], rotation_normal = 1 }]"}}},
      {springs_in_plane, {{"spring", "[{ cracks = [0], opening = 1 }]"}}},
      {part_through, {{"spring", "[{ cracks = [0], depth = 0.04 }]"}, {"discretization.formulation", "galerkin"}}},
  };
}

std::vector<Sample> samples_of_stiffeners() {
  const auto rib = [](const std::string& more) -> Settings {
    return {{"stiffener", "[{ along = [[0.2, 0.2], [0.8, 0.2]], axial = 1" + more + " }]"},
            {"discretization.formulation", "galerkin"}};
  };
  const std::string ply = "thickness = 0.05, E1 = 2, E2 = 1, nu12 = 0.2, G12 = 1, G13 = 1, G23 = 1";
  return {{coupled_section, rib(", eccentricity = 0.1")},
          {axial_stiffener, rib("")},
          {heavier_on_one_side,
           {{"section", "{ plies = [{ density = 1, " + ply + " }, { density = 2, " + ply + " }] }"},
            {"discretization.formulation", "galerkin"}}}};
}

/// The case with what some samples ask for; nothing where two of them ask for different values of a key.
std::optional<std::vector<std::string>> settings_of(const std::vector<const Sample*>& asked) {
  Settings all;
  std::string loads;
  for (const auto* one : asked) {
    for (const auto& [key, value] : one->settings)
      if (const auto [entry, fresh] = all.emplace(key, value); !fresh && entry->second != value) return std::nullopt;
    if (!one->load.empty()) loads += ", " + one->load;
  }
  const auto kind = all.contains("analysis.kind") ? all["analysis.kind"] : "";
  const bool flat = kind == "buckling" || kind == "frequencies";
  std::vector<std::string> result;
  if (loads.empty() && (all.contains("case") || flat))
    result.push_back("-load");
  else
    result.push_back((flat ? "load=[" + loads.substr(2) : "load=[{ kind = 'pressure', value = 1 }" + loads) + "]");
  for (const auto& [key, value] : all) result.push_back(key + "=" + value);
  return result;
}

std::set<Part> parts(const Sample& sample) {
  const auto settings = *settings_of({&sample});
  for (const auto& problem : problems(plain, settings)) FAIL_CHECK(problem.key << ": " << problem.what);
  if (!problems(plain, settings).empty()) return {};
  const auto found = cases::parts_of(read(plain, settings).content, sample.part == processes);
  return {found.begin(), found.end()};
}

}  // namespace

TEST_CASE("the table of what goes with what in the guide is the program's") {
  std::ifstream file(PDPLATE_SOURCE_DIR "/cases/guide/combinations.md");
  std::stringstream text;
  text << file.rdbuf();
  CHECK_THAT(text.str(), Catch::Contains(cases::exclusion_list()));
}

TEST_CASE("every pair of parts is refused for the reason in the table, or for none of these reasons") {
  auto all = samples();
  for (const auto& more : {samples_of_supports(), samples_of_stiffeners()})
    std::ranges::copy(more, std::back_inserter(all));
  std::ranges::copy(samples_in_plane(), std::back_inserter(all));
  std::set<Part> tried;
  std::vector<std::set<Part>> of;
  for (const auto& sample : all) {
    INFO(cases::words_of(sample.part));
    of.push_back(parts(sample));
    CHECK(of.back().contains(sample.part));
    tried.insert(of.back().begin(), of.back().end());
  }
  std::set<std::string> reasons;
  for (const auto& row : cases::exclusions()) reasons.insert(row.reason);
  std::size_t pairs = 0, refused = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const auto settings = settings_of({&all[i], &all[j]});
      if (!settings) continue;
      auto both = of[i];
      both.insert(of[j].begin(), of[j].end());
      std::set<std::string> found, keys;  // a key, or a table, with another problem is not complained of again
      for (const auto& problem : problems(plain, *settings, both.contains(processes))) {
        if (reasons.contains(problem.what)) found.insert(problem.what);
        keys.insert(problem.key);
      }
      INFO(cases::words_of(all[i].part) << " beside " << cases::words_of(all[j].part));
      for (const auto& row : cases::exclusions())
        if (both.contains(row.one) && both.contains(row.other))
          CHECK((found.contains(row.reason) || keys.contains(row.key) ||
                 keys.contains(row.key.substr(0, row.key.find('.')))));
      ++pairs, refused += !found.empty();
    }
  CHECK(pairs > 150);
  CHECK(refused >= 40);
  for (const auto& row : cases::exclusions()) {
    INFO(row.reason);
    CHECK((tried.contains(row.one) || row.one == tips_in_motion));
  }
}

TEST_CASE("compatibility: large deflections and bonds that break are advised where they are accepted") {
  const auto may_stretch = [](const std::vector<std::string>& settings) {
    return cases::may_stretch(read(plain, settings).content);
  };
  CHECK(may_stretch({}));
  CHECK_FALSE(may_stretch({"foundation=[{modulus=1,lifts_off=true}]"}));
  CHECK_FALSE(may_stretch({"discretization.formulation=ordinary", "discretization.boundary=surface_nodes"}));
  const std::vector<std::string> moving{"analysis={kind='dynamic',duration=1}", "section.density=1"};
  CHECK(may_stretch(moving));
  auto settings = moving;
  settings.emplace_back("analysis.damping={stiffness=1}");
  CHECK_FALSE(may_stretch(settings));
  settings = moving;
  settings.emplace_back("growth={fracture_energy=1}");
  CHECK_FALSE(may_stretch(settings));
  CHECK(cases::may_break_bonds(read(plain, settings).content));
  settings.emplace_back("load=[{kind='edge_traction',edges=['right'],value=1},{kind='pressure',value=1}]");
  CHECK_FALSE(cases::may_break_bonds(read(plain, settings).content));
}
