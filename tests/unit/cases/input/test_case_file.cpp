#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

const std::string dynamic =
    with_line(with_line(plain, 17, "kind = \"dynamic\"\nduration = 0.5"), 4, "thickness = 0.1\ndensity = 7850");

}  // namespace

TEST_CASE("a plain case is read with its defaults") {
  const auto file = read(plain);
  const auto& c = file.content;
  CHECK(c.section.young == 1000);
  CHECK(c.section.shear_correction == 5.0 / 6);
  CHECK(c.outline.outer.vertices.size() == 4);
  REQUIRE(c.cracks.size() == 1);
  CHECK(c.cracks[0][1] == geometry::Point(0.3, 0));
  CHECK(c.discretization.horizon_ratio == 3.015);
  CHECK(c.discretization.formulation == &plate::galerkin);
  CHECK(c.discretization.surface_correction == plate::SurfaceCorrection::position_aware);
  REQUIRE(c.supports.size() == 1);
  CHECK(c.supports[0].kind == plate::SupportKind::clamped);
  CHECK(c.supports[0].edges == std::vector<std::string>{"left"});
  CHECK(c.loads.at(0).as<plate::Pressure>()->value == 1);
  CHECK(c.analysis.method == cases::Analysis::Method::cg);
  CHECK_FALSE(c.srif);
  CHECK(c.output.vtk);
  CHECK(c.title.starts_with("case_file_test_"));
}

TEST_CASE("places name the line of a key or of its nearest parent") {
  const File text(plain);
  const auto file = cases::read_case(text.path(), {"discretization.spacing=0.1"});
  const std::string name = text.path().string();
  CHECK(file.place("section.poisson") == name + ":3");
  CHECK(file.place("geometry.cracks[0]") == name + ":7");
  CHECK(file.place("support[0].kind") == name + ":11");
  CHECK(file.place("support[0].points") == name + ":10");
  CHECK(file.place("section.density") == name + ":1");
  CHECK(file.place("output.every") == name);
  CHECK(file.place("discretization.spacing") == "--set discretization.spacing");
}

TEST_CASE("more vertices, cracks and probes than are looked at in seconds are refused by their number") {
  const auto list = [](const std::string& entry, int count) {
    std::string result = "[";
    for (int i = 0; i < count; ++i) result += entry + ",";
    return result + "]";
  };
  const File text(plain);
  const auto said = [&](const std::string& setting) -> std::string {
    try {
      cases::read_case(text.path(), {setting});
    } catch (const cases::CaseError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(said("geometry.cracks=" + list("[[0,0],[0.1,0]]", 5001)),
             Catch::Contains("geometry.cracks: 10002 points or entries, must be at most 10000"));
  CHECK_THAT(said("geometry.holes=" + list("{circle=[0,0,0.1]}", 10001)),
             Catch::Contains("geometry.holes: 10001 points"));
  CHECK_THAT(said("geometry.outline={polygon=" + list("[0,0]", 10001) + "}"),
             Catch::Contains("geometry.outline.polygon: 10001 points"));
  CHECK_THAT(said("load=" + list("{kind=\"pressure\",value=1}", 10001)),
             Catch::Contains("load: 10001 points or entries"));
}

TEST_CASE("a frequency analysis takes its own method and tolerance") {
  auto text = with_line(with_line(plain, 17, "kind = \"frequencies\""), 4, "thickness = 0.1\ndensity = 7850");
  for (int line = 14; line <= 16; ++line) text = with_line(text, line, "");
  const auto c = read(text).content;
  CHECK(c.analysis.kind == cases::Analysis::Kind::frequencies);
  CHECK(c.analysis.method == cases::Analysis::Method::lanczos);
  CHECK(c.analysis.tolerance == 1e-4);
  CHECK(c.analysis.modes == 6);
  CHECK(c.loads.empty());
  CHECK(read(text, {"analysis.modes=3", "analysis.tolerance=1e-6"}).content.analysis.tolerance == 1e-6);
  const auto written = cases::resolved_toml(c);
  CHECK(cases::resolved_toml(read(written).content) == written);
}

TEST_CASE("dynamic analysis takes its own method and keys") {
  const auto c = read(dynamic).content;
  CHECK(c.analysis.kind == cases::Analysis::Kind::dynamic);
  CHECK(c.analysis.method == cases::Analysis::Method::central_difference);
  CHECK(c.analysis.duration == 0.5);
  CHECK_FALSE(c.analysis.time_step);
  CHECK(read(dynamic, {"analysis.time_step=1e-5"}).content.analysis.time_step == 1e-5);
  CHECK(read(dynamic, {"load[0].history=[[0, 0], [1, 2.5]]"}).content.loads[0].history.table ==
        std::vector<std::pair<double, double>>{{0, 0}, {1, 2.5}});
  using enum cases::Analysis::Method;
  const auto graded = [](std::vector<std::string> settings) {
    settings.emplace_back("discretization.tip_spacing=0.02");
    return read(dynamic, settings).content.analysis.method;
  };
  CHECK(graded({}) == lanczos);
  CHECK(graded({"analysis.nonlinear=true"}) == central_difference);
  CHECK(graded({"load=[{kind='edge_traction',edges=['right'],value=1}]"}) == central_difference);
}

TEST_CASE("overrides are values of TOML or bare words") {
  const auto c =
      read(plain, {"section.young=2e11", "support[0].kind=simply_supported", "load.0.value=-3",
                   "output.probes.tip=[0.3, 0]", "title=a bare title", "geometry.cracks=[[[0, 0], [0, 0.5]]]",
                   "load[1].kind=\"point_force\"", "load[1].value=2", "load[1].position=[0.5, 0.5]"})
          .content;
  CHECK(c.section.young == 2e11);
  CHECK(c.supports[0].kind == plate::SupportKind::simply_supported);
  REQUIRE(c.loads.size() == 2);
  CHECK(c.loads[0].as<plate::Pressure>()->value == -3);
  CHECK(c.loads[1].as<plate::PointForce>()->position == geometry::Point(0.5, 0.5));
  CHECK(c.output.probes.at("tip") == geometry::Point(0.3, 0));
  CHECK(c.title == "a bare title");
  CHECK(c.cracks.at(0).at(1) == geometry::Point(0, 0.5));
}

TEST_CASE("wrong overrides are problems like any other") {
  expect(plain, "--set section.poisson", "section.poisson", "0.7 given, must be a number in (-1, 0.5)",
         {"section.poisson=0.7"});
  expect(plain, "--set discretization.horizn", "discretization.horizn", "did you mean 'horizon_ratio'?",
         {"discretization.horizn=3"});
  expect(plain, "--set support.0.kind", "support[0].kind", "did you mean 'clamped'?", {"support.0.kind=clampd"});
  expect(plain, "--set load[3].value", "load[3].value", "leads nowhere", {"load[3].value=1"});
  expect(plain, "--set title.x", "title.x", "leads nowhere", {"title=a", "title.x=1"});
  expect(plain, "--set srf.rows", "srf", "did you mean 'srif'?", {"srf.rows=1"});
  expect(plain, "--set nonsense", "nonsense", "must be key=value", {"nonsense"});
}

TEST_CASE("a resolved case reads as the same case") {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"static", "dynamic"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(PDPLATE_SOURCE_DIR) / "cases" / folder))
      if (entry.path().extension() == ".toml" && !entry.path().stem().string().starts_with("study_"))
        files.push_back(entry.path());
  REQUIRE(files.size() >= 12);
  for (const auto& path : files) {
    INFO(path);
    const auto resolved = cases::resolved_toml(cases::read_case(path, {}).content);
    CHECK(cases::resolved_toml(read(resolved).content) == resolved);
  }
}

TEST_CASE("what is resolved keeps every digit, quote and form") {
  const auto resolved = [](const std::string& text, const std::vector<std::string>& overrides) {
    return cases::resolved_toml(read(text, overrides).content);
  };
  const std::vector<std::vector<std::string>> variants{
      {"title=\"a \\\"quoted\\\" \\\\ title\\n\"", "section.young=0.1", "section.density=3"},
      {"load[0].value=-0.0", "analysis.tolerance=1e-14", "discretization.horizon_ratio=3.3333333333333335"},
      {"geometry.outline={ polygon=[[0,0],[1,0],[1,1],[0,1]], edges=[\"left\",\"a\",\"b\",\"a\"] }",
       "geometry.cracks=[]"},
      {"geometry.holes=[{ circle=[0.5,0.5,0.1] }, { polygon=[[-0.5,-0.5],[-0.4,-0.5],[-0.5,-0.4]] }]"},
      {"support[0].kind=pinned", "support[0]={ kind=\"pinned\", points=[[-1,-1],[1,-1],[1,1]] }"},
      {"load[0]={ kind=\"edge_moment\", edges=[\"top\"], tensor=[1,2,3] }"},
      {"load[0]={ kind=\"edge_moment\", edges=[\"top\"], value=1, twist=2 }"},
      {"load[0]={ kind=\"pressure\", value=1, gradient=[1,2], from=[0.1,0], on={ circle=[0,0,0.1] } }"},
      {"load[0]={ kind=\"pressure\", value=1, on={ polygon=[[0,0],[0.4,0],[0,0.3]] } }"},
      {"load[0]={ kind=\"line_load\", value=-1, along=[[0,0],[0.5,0.3],[1,1]] }"},
      {"srif={ window=0.1, rows=2, skip=1, normalize={ moment=2 }, half_length=0.3 }", "output.fields=[]"}};
  for (const auto& variant : variants) {
    const auto once = resolved(plain, variant);
    CHECK(resolved(once, {}) == once);
  }
  const std::vector<std::vector<std::string>> in_time{
      {"load[0].history=sine", "load[0].frequency=50", "output.every=0.1"},
      {"load[0].history=ramp", "load[0].rise_time=0.3", "output.history_every=0.1"},
      {"load[0].history=[[0,1],[0.1,3]]", "analysis.time_step=1e-5", "analysis.safety=0.5"}};
  for (const auto& variant : in_time) {
    const auto once = resolved(dynamic, variant);
    CHECK(resolved(once, {}) == once);
  }
}
