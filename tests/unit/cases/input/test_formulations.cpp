// Which formulation "auto" stands for, and that a resolved case keeps it.
#include "cases/input/formulations.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cases/driver/run.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "post/files/summary.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace case_text;

namespace {

struct Asked {
  std::vector<std::string> settings;
  std::string of;       // that is asked for, in words
  bool refused = true;  // beside formulation = "galerkin"
};

const std::vector<std::string> motion{"section.density=1", "analysis={kind=\"dynamic\", duration=0.05}"};

std::vector<std::string> in_motion(const std::string& setting) {
  auto all = motion;
  all.push_back(setting);
  return all;
}

/// Everything that only bonds have.
std::vector<Asked> all_asked() {
  return {{{"discretization.horizon_ratio=3.015"}, "horizon_ratio", false},
          {{"discretization.horizon_ratio=4"}, "horizon_ratio", false},
          {{"discretization.influence=inverse"}, "influence", false},
          {{"discretization.influence=constant"}, "influence"},
          {{"discretization.volume_correction=linear"}, "volume_correction", false},
          {{"discretization.volume_correction=none"}, "volume_correction"},
          {{"discretization.surface_correction=position_aware"}, "surface_correction", false},
          {{"discretization.surface_correction=volume"}, "surface_correction"},
          {{"discretization.full_horizon=lattice"}, "full_horizon"},
          {{"discretization.twist_match=paper"}, "twist_match"},
          {{"discretization.boundary=images"}, "boundary", false},
          {{"discretization.boundary=layer"}, "boundary"},
          {{"support[0].kind=clamped_layer"}, "a layer outside the plate"},
          {{"support[0].kind=simply_supported_layer"}, "a layer outside the plate"},
          {{"support[0].kind=simply_supported_hard_layer"}, "a layer outside the plate"},
          {{"analysis.preconditioner=local"}, "preconditioner = \"local\""},
          {{"analysis.preconditioner=two_level"}, "preconditioner = \"two_level\""},
          {in_motion("analysis.precision=mixed"), "precision = \"mixed\""},
          {in_motion("growth={fracture_energy=1}"), "growth in motion"},
          {in_motion("growth={fracture_energy=1, criterion=\"bond_energy\"}"), "bonds that break one by one"},
          {{"growth={fracture_energy=1, criterion=\"bond_energy\"}"}, "bonds that break one by one"},
          {{"growth={fracture_energy=1, criterion=\"curvature_shear\"}"}, "bonds that break one by one"},
          {{"section.density=1", "growth={fracture_energy=1, unstable=\"move\", duration=1}"}, "unstable = \"move\""},
          {{"discretization.twist_match=paper", "discretization.horizon_ratio=4", "support[0].kind=clamped_layer"},
           "horizon_ratio, twist_match, a layer outside the plate"}};
}

/// What asks for neither formulation, or for the Galerkin plate.
const std::vector<std::vector<std::string>> nothing_asked{{},
                                                          {"discretization.spacing=0.1"},
                                                          {"discretization.tip_spacing=0.01"},
                                                          {"analysis.preconditioner=levels"},
                                                          {"analysis.preconditioner=diagonal"},
                                                          {"analysis.method=adr"},
                                                          {"support[0].kind=symmetry"},
                                                          {"growth={fracture_energy=1, unstable=\"stop\"}"},
                                                          {"srif={window_horizons=3}"},
                                                          motion};

std::vector<std::string> with(std::vector<std::string> settings, const std::string& further) {
  settings.push_back(further);
  return settings;
}

/// Is the case for this, for this reason, and its resolved form for the same?
void check(const std::vector<std::string>& settings, const plate::FormulationKind& formulation,
           const std::string& reason) {
  CAPTURE(settings, problems(plain, settings).size());
  const auto c = read(plain, settings).content;
  CHECK(c.discretization.formulation == &formulation);
  CHECK(c.formulation_reason == reason);
  const auto resolved = cases::resolved_toml(c);
  CHECK_THAT(resolved, Catch::Contains("formulation = \"" + formulation.name + "\""));
  const auto again = read(resolved).content;
  CHECK(again.discretization.formulation == &formulation);
  CHECK(again.formulation_reason == "as the case says");
  CHECK(cases::resolved_toml(again) == resolved);
}

}  // namespace

TEST_CASE("auto: bonds where the case asks for what only they have, else the Galerkin plate, the reason says it") {
  for (const auto& asked : all_asked()) {
    check(asked.settings, plate::ordinary, "auto: the case asks for " + asked.of);
    check(with(asked.settings, "discretization.formulation=auto"), plate::ordinary,
          "auto: the case asks for " + asked.of);
    check(with(asked.settings, "discretization.formulation=ordinary"), plate::ordinary, "as the case says");
  }
  for (const auto& settings : nothing_asked) {
    check(settings, plate::galerkin, "auto: nothing asks for bonds");
    check(with(settings, "discretization.formulation=auto"), plate::galerkin, "auto: nothing asks for bonds");
    check(with(settings, "discretization.formulation=galerkin"), plate::galerkin, "as the case says");
  }
}

TEST_CASE("auto: what it takes bonds for is what the Galerkin plate refuses, or takes without effect") {
  for (const auto& asked : all_asked()) {
    CAPTURE(asked.settings);
    const auto found = problems(plain, with(asked.settings, "discretization.formulation=galerkin"));
    CHECK(found.empty() != asked.refused);
  }
}

TEST_CASE("bonds carry loads in the plane with bending, nodes on edges refuse what couples both") {
  const std::vector<std::string> pulled{"load=[{kind='edge_traction',edges=['right'],value=1}]",
                                        "support[0].in_plane=\"fixed\"", "discretization.formulation=ordinary"};
  CHECK(problems(plain, pulled).empty());
  const auto refused = [&](const std::vector<std::string>& more, const std::string& key) {
    auto settings = pulled;
    settings.insert(settings.end(), more.begin(), more.end());
    CAPTURE(key);
    CHECK(problems(plain, settings).empty());
    settings.push_back("discretization.boundary=surface_nodes");
    const auto found = problems(plain, settings);
    CHECK(std::ranges::any_of(found, [&](const auto& problem) {
      return problem.key == key && problem.what.find("act on bending with boundary") != std::string::npos;
    }));
  };
  refused({"analysis.nonlinear=true"}, "analysis.nonlinear");
  refused({"analysis={kind=\"buckling\"}"}, "analysis.kind");
  refused({"analysis={kind=\"frequencies\"}", "section.density=1"}, "analysis.kind");
}

TEST_CASE("auto: by a line of the file as by an override") {
  const auto c = read(with_line(plain, 9, "spacing = 0.05\nsurface_correction = \"position_aware\"")).content;
  CHECK(c.discretization.formulation == &plate::ordinary);
  CHECK(c.formulation_reason == "auto: the case asks for surface_correction");
  const auto stated = with_line(plain, 9, "spacing = 0.05\nhorizon_ratio = 4\nformulation = \"galerkin\"");
  CHECK(read(stated).content.discretization.formulation == &plate::galerkin);
  CHECK(read(stated, {"discretization.formulation=auto"}).content.discretization.formulation == &plate::ordinary);
}

TEST_CASE("auto: what asks for both formulations is refused") {
  expect(with_line(plain, 9, "spacing = 0.05\ntip_spacing = 0.01\nhorizon_ratio = 4"), ":10",
         "discretization.tip_spacing",
         "is used with formulation = galerkin only, and bonds are asked for by horizon_ratio");
  expect(with_line(plain, 9, "spacing = 0.05\nhorizon_ratio = 4"), "--set analysis.preconditioner",
         "analysis.preconditioner", "\"levels\" is of formulation = \"galerkin\"", {"analysis.preconditioner=levels"});
  // a formulation that is no word is the one problem of its case
  expect(with_line(plain, 9, "spacing = 0.05\nformulation = \"bonds\"\nsurface_correction = \"none\""), ":10",
         "discretization.formulation", "must be one of \"ordinary\", \"galerkin\", \"auto\"");
}

TEST_CASE("auto: a run says which it was and why, and its resolved case gives the same numbers") {
  const std::string text =
      with_line(plain, 9, "spacing = 0.1") + "[srif]\n[output]\nfields = []\nprobes = { far = [0.9, 0.0] }\n";
  for (const bool bonds : {false, true}) {
    const small_run::TemporaryFolder folder;
    std::vector<std::string> settings;
    if (bonds) settings.push_back("discretization.surface_correction=position_aware");
    const auto first = cases::run(read(text, settings), {folder / "first", true});
    CHECK(first.formulation == (bonds ? "ordinary" : "galerkin"));
    CHECK((first.points == 400) == bonds);  // one in each cell; or on all edges and faces too
    const auto again = cases::run(cases::read_case(folder / "first/case.resolved.toml", {}), {folder / "again", true});
    CHECK(again.formulation_reason == "as the case says");
    CHECK(again.digest == first.digest);
    for (const char* name : {"case.resolved.toml", "history.csv", "srif.csv", "probes.csv"}) {
      INFO(name);
      CHECK(small_run::text_of(folder / "again" / name) == small_run::text_of(folder / "first" / name));
    }
    const auto json = nlohmann::json::parse(small_run::text_of(folder / "first/summary.json"));
    CHECK(json["formulation"] == (bonds ? "ordinary" : "galerkin"));
    CHECK(json["formulation_reason"] ==
          (bonds ? "auto: the case asks for surface_correction" : "auto: nothing asks for bonds"));
  }
}

TEST_CASE("points are refined at tips where factors need it, and the resolved case keeps them") {
  const auto spacing_at_tips = [&](const std::string& text, const std::vector<std::string>& settings) {
    const auto content = read(text, settings).content;
    CHECK(cases::resolved_toml(read(cases::resolved_toml(content)).content) == cases::resolved_toml(content));
    return content.discretization.tip_spacing;
  };
  const std::string asked = plain + "[srif]\n";
  const double layer = read(asked).content.section.layer() / read(asked).content.section.thickness;
  const auto with_thickness = [](double thickness) { return fmt::format("section.thickness={}", thickness); };
  const std::string spacing = "discretization.spacing=0.01", crack = "geometry.cracks=[[[-0.3, 0.0], [0.3, 0.0]]]";
  CHECK_FALSE(spacing_at_tips(asked, {spacing, crack, with_thickness(0.12)}));
  CHECK(*spacing_at_tips(asked, {spacing, crack, with_thickness(0.11)}) == Approx(0.11 * layer / 6));
  CHECK(*spacing_at_tips(asked, {spacing, crack, with_thickness(0.02)}) == Approx(0.02 * layer / 6));
  // no closer than the spacing over 256
  CHECK(*spacing_at_tips(asked, {spacing, crack, with_thickness(1e-5)}) == Approx(0.01 / 256));
  // what lies within 24 spacings of a tip
  const std::string short_kink = "geometry.cracks=[[[-0.3, 0.0], [0.25, 0.0], [0.3, 0.05]]]";
  CHECK(*spacing_at_tips(asked, {spacing, short_kink, with_thickness(0.2)}) == Approx(std::hypot(0.05, 0.05) / 32));
  // at re-entrant corners, also without factors
  const std::string corner =
      "geometry.outline={polygon=[[0,0],[1,0],[1,0.5],[0.5,0.5],[0.5,1],[0,1]], "
      "edges=[\"left\", \"b\", \"c\", \"d\", \"e\", \"f\"]}";
  const std::string none = "geometry.cracks=[]", square = "geometry.outline={rectangle=[0, 0, 1, 1]}";
  CHECK(*spacing_at_tips(plain, {spacing, none, corner}) == 0.01);
  CHECK_FALSE(spacing_at_tips(plain, {spacing, none, square}));
  CHECK_FALSE(spacing_at_tips(plain, {spacing, none, corner, "discretization.refine_tips=false"}));
  // at corners of polygon holes, with a growth that needs few points
  const std::string hole = "geometry.holes=[{polygon=[[0.1,0.1],[0.3,0.1],[0.2,0.3]]}]";
  CHECK(*spacing_at_tips(plain, {spacing, none, square, hole}) == 0.01);
  CHECK(read(plain, {spacing, none, square, hole}).content.discretization.spacing_growth == 0.3);
  CHECK(read(plain, {spacing, none, corner, hole}).content.discretization.spacing_growth == 0.2);
  CHECK_FALSE(spacing_at_tips(plain, {spacing, none, square, "geometry.holes=[{circle=[0.5,0.5,0.1]}]"}));
  CHECK_FALSE(spacing_at_tips(plain, {spacing, none, corner, "discretization.formulation=ordinary"}));
  CHECK_FALSE(spacing_at_tips(
      plain, {spacing, none, corner, "section.density=1", "analysis={kind=\"dynamic\", duration=0.05}"}));
  // not where nothing asks for factors, points are given, tips grow, or the plate moves
  CHECK_FALSE(spacing_at_tips(plain, {spacing, crack, with_thickness(0.02)}));
  CHECK_FALSE(spacing_at_tips(asked, {spacing, crack, with_thickness(0.02), "discretization.refine_tips=false"}));
  CHECK(*spacing_at_tips(asked, {spacing, crack, with_thickness(0.02), "discretization.tip_spacing=0.004"}) == 0.004);
  CHECK_FALSE(spacing_at_tips(asked, {spacing, crack, with_thickness(0.02), "growth={fracture_energy=1}"}));
  CHECK_FALSE(spacing_at_tips(asked, {spacing, crack, with_thickness(0.02), "discretization.formulation=ordinary"}));
  CHECK_FALSE(spacing_at_tips(asked, {spacing, crack, with_thickness(0.02), "section.density=1",
                                      "analysis={kind=\"dynamic\", duration=0.05}"}));
}

namespace {

/// The resolved case without the line of its recipe.
std::string without_recipe(const cases::Case& content) {
  std::string text = cases::resolved_toml(content);
  const auto begin = text.find("recipe = ");
  REQUIRE(begin != std::string::npos);
  return text.erase(begin, text.find('\n', begin) + 1 - begin);
}

}  // namespace

TEST_CASE("recipe: one key gives the case that all of its keys give") {
  const std::string cracked = "title = \"a plate\"\n" + plain + "[srif]\n";
  std::vector<std::string> all{"discretization.formulation=ordinary",
                               "discretization.horizon_ratio=3.015",
                               "discretization.influence=inverse",
                               "discretization.volume_correction=linear",
                               "discretization.surface_correction=arbitrary_horizon",
                               "discretization.full_horizon=continuum",
                               "discretization.twist_match=paper",
                               "discretization.boundary=images",
                               "srif.methods=[\"displacement_extrapolation\"]",
                               "srif.window_horizons=2",
                               "srif.rows=1"};
  CHECK(without_recipe(read(cracked, {"recipe=dai2021"}).content) ==
        cases::resolved_toml(read(cracked, with(all, "analysis.method=adr")).content));
  auto moving = motion;
  moving.push_back("recipe=dai2021");
  all.insert(all.begin(), motion.begin(), motion.end());
  CHECK(without_recipe(read(cracked, moving).content) ==
        cases::resolved_toml(read(cracked, with(all, "analysis.method=central_difference")).content));
  CHECK_FALSE(read(plain, {"recipe=dai2021"}).content.srif);
}

TEST_CASE("recipe: keys of the file hold, and the results name them") {
  const auto settings = with({"recipe=dai2021"}, "discretization.surface_correction=none");
  const auto file = read(plain, settings);
  CHECK(file.content.discretization.surface_correction == plate::SurfaceCorrection::none);
  CHECK(file.content.discretization.twist_match == plate::TwistMatch::paper);
  CHECK_THAT(file.content.recipe_keys,
             Catch::StartsWith("dai2021: discretization.formulation = \"ordinary\"") &&
                 Catch::EndsWith("; the case has instead discretization.surface_correction = \"none\""));
  const auto again = read(cases::resolved_toml(file.content)).content;
  CHECK(again.recipe_keys == file.content.recipe_keys);
  CHECK(cases::resolved_toml(again) == cases::resolved_toml(file.content));
  const small_run::TemporaryFolder scratch;
  cases::run(read(plain, with(settings, "discretization.spacing=0.2")), {scratch / "results", true});
  const auto json = nlohmann::json::parse(small_run::text_of(scratch / "results/summary.json"));
  CHECK(json["recipe"] == file.content.recipe_keys);
}

TEST_CASE("recipe: what does not go with it is refused once, at its place") {
  expect("recipe = \"dai2021\"\n" + plain, ":1", "recipe", "is a way of bonds",
         {"discretization.formulation=galerkin"});
  expect("recipe = \"dai\"\n" + plain, ":1", "recipe", "must be one of \"dai2021\"");
  expect("recipe = \"dai2021\"\n" + plain, ":1, recipe", "analysis.method", "choose method = \"direct\"",
         {"discretization.boundary=surface_nodes"});
  auto settings = motion;
  settings.push_back("srif={second_formulation=true}");
  settings.push_back("recipe=dai2021");
  const auto other = cases::in_other_formulation(read(plain, settings)).content;
  CHECK(other.recipe.empty());
  CHECK(other.recipe_keys.empty());
}
