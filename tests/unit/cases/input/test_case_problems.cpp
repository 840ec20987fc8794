#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("unknown keys are named with the nearest known one") {
  expect(with_line(plain, 9, "spacing = 0.05\nhorizn = 3"), ":10", "discretization.horizn",
         "did you mean 'horizon_ratio'?");
  expect(with_line(plain, 9, "spacing = 0.05\nspcing = 3"), ":10", "discretization.spcing", "did you mean 'spacing'?");
  expect(with_line(plain, 4, "thickness = 0.1\nhorizon_ratio = 3"), ":5", "section.horizon_ratio",
         "did you mean 'discretization.horizon_ratio'?");
  expect(with_line(plain, 4, "thickness = 0.1\nqqqqqq = 3"), ":5", "section.qqqqqq", "known here: young, poisson");
  expect("titel = 1\n" + plain, ":1", "titel", "did you mean 'title'?");
}

TEST_CASE("values out of their bounds or of another type are refused") {
  expect(with_line(plain, 3, "poisson = 0.7"), ":3", "section.poisson", "0.7 given, must be a number in (-1, 0.5)");
  expect(with_line(plain, 2, "young = \"stiff\""), ":2", "section.young", "\"stiff\" given, must be a finite number");
  expect(with_line(plain, 2, "young = 0"), ":2", "section.young", "0 given, must be a number > 0");
  expect(with_line(plain, 2, "young = inf"), ":2", "section.young", "inf given, must be a finite number");
  expect(with_line(plain, 4, "thickness = 0.1\nshear_correction = 1.5"), ":5", "section.shear_correction", "in (0, 1]");
  expect(with_line(plain, 15, "value = nan"), ":15", "load[0].value", "nan given");
  expect(with_line(plain, 9, "spacing = 0.05\nhorizon_ratio = 1.2"), ":10", "discretization.horizon_ratio",
         "in [1.5, 20]");
  expect(with_line(plain, 9, "spacing = 0.6"), ":9", "discretization.spacing", "0.6 given, must be at most 0.5");
  expect(with_line(plain, 17, "kind = \"static\"\ntolerance = 1"), ":18", "analysis.tolerance", "in [1e-14, 0.1]");
  expect(with_line(plain, 17, "kind = \"static\"\nmax_iterations = 1.5"), ":18", "analysis.max_iterations",
         "an integer");
  expect("units = \"si\"\n" + plain, ":1", "units", "did you mean 'SI'?");
  expect("section = 3\n" + with_line(with_line(with_line(with_line(plain, 1, ""), 2, ""), 3, ""), 4, ""), ":1",
         "section", "must be a table");
  expect(plain, "--set load[0]", "load[0]", "3 given, must be a table", {"load[0]=3"});
  expect(plain, "--set load", "load", "3 given, must be [[load]]", {"load=3"});
}

TEST_CASE("what is not in this version is refused with the reason") {
  const auto discretization = [](const std::string& line) { return with_line(plain, 9, "spacing = 0.05\n" + line); };
  expect(discretization("formulation = \"finite_elements\""), ":10", "discretization.formulation",
         "must be one of \"ordinary\", \"galerkin\"");
  expect(discretization("surface_correction = \"position-aware\""), ":10", "discretization.surface_correction",
         "did you mean 'position_aware'?");
  expect(discretization("influence = \"invers\""), ":10", "discretization.influence", "did you mean 'inverse'?");
  expect(plain + "[srif]\nmethods = [\"j_integral\"]\n", ":19", "srif.methods",
         "must be one of \"virtual_crack_extension\"");
}

TEST_CASE("growth: what it needs, and what it cannot do") {
  const std::string growth = plain + "[growth]\n";  // line 18
  expect(growth + "criterion = \"energy_release\"\n", ":18", "growth.fracture_energy", "is missing");
  expect(growth + "fracture_energy = 0\n", ":19", "growth.fracture_energy", "must be a number > 0");
  expect(growth + "fracture_energy = 1\ncriterion = \"stretch\"\n", ":20", "growth.criterion",
         "must be one of \"energy_release\"");
  expect(growth + "fracture_energy = 1\nno_fail = [[0, 0, 0, 1]]\n", ":20", "growth.no_fail[0]", "with xmin < xmax");
  expect(with_line(growth + "fracture_energy = 1\n", 7, ""), ":18", "growth", "there is no crack tip that could grow");
  expect(growth + "fracture_energy = 1\n[srif]\nmethods = [\"displacement_extrapolation\"]\n", ":21", "srif.methods",
         "growth needs an energy release rate");
  expect(growth + "fracture_energy = 1\n[srif]\nsecond_formulation = true\n", ":21", "srif.second_formulation",
         "is not available with [growth]");
  const auto motion =
      with_line(growth + "fracture_energy = 1\n", 17, "kind = \"dynamic\"\nduration = 1");  // growth at 19
  expect(motion, "--set discretization.formulation", "discretization.formulation",
         "growth in motion severs bonds over a horizon", {"section.density=1", "discretization.formulation=galerkin"});
  expect(motion + "control = \"load\"\n", ":21", "growth.control", "is used in statics only", {"section.density=1"});
}

TEST_CASE("growth by single bonds: what it needs, and what it cannot do") {
  const std::string bonds = plain + "[growth]\ncriterion = \"bond_energy\"\n";  // line 18
  expect(bonds, ":18", "growth.fracture_energy", "is missing");
  expect(bonds + "fracture_energy = 1\ndirection = \"straight\"\n", ":21", "growth.direction",
         "bonds break where they fail");
  expect(bonds + "fracture_energy = 1\ncritical_shear = 1\n", ":21", "growth.critical_shear",
         "of criterion = \"curvature_shear\"");
  expect(bonds + "fracture_energy = 1\n", "--set analysis.method", "analysis.method",
         "breaking bonds takes a solution for each", {"analysis.method=direct"});
  expect(bonds + "fracture_energy = 1\n", "--set analysis.preconditioner", "analysis.preconditioner",
         "one of their own", {"analysis.preconditioner=local"});
  expect(bonds + "fracture_energy = 1\nmax_length = 0.6\n", ":21", "growth.max_length",
         "must be larger than the 0.6 of geometry.cracks");
  expect(bonds + "fracture_energy = 1\n", "--set discretization.formulation", "discretization.formulation",
         "bonds that break one by one are bonds over a horizon", {"discretization.formulation=galerkin"});
  expect(bonds + "fracture_energy = 1\nunstable = \"move\"\nduration = 1\n", ":21", "growth.unstable",
         "cannot be handed over", {"section.density=1"});
  expect(plain + "[growth]\nfracture_energy = 1\napparent_toughness = 1.1\n", ":20", "growth.apparent_toughness",
         "of criteria for bonds");
  // limits in place of the fracture energy; no crack is needed where bonds break one by one
  CHECK(read(with_line(plain, 7, "") + "[growth]\ncriterion = \"curvature_shear\"\ncritical_curvature = 2\n")
            .content.growth->critical_curvature == 2);
}

TEST_CASE("growth that goes over into motion needs what motion needs") {
  const std::string moves = plain + "[growth]\nfracture_energy = 1\nunstable = \"move\"\n";  // line 18
  expect(moves, ":18", "growth.duration", "is missing", {"section.density=1"});
  expect(moves + "duration = 1\n", ":1", "section.density", "the plate may begin to move");
  expect(moves + "duration = 1\ncontrol = \"displacement\"\n", ":22", "growth.control", "must be \"load\"",
         {"section.density=1"});
  expect(plain + "[growth]\nfracture_energy = 1\nduration = 1\n", ":20", "growth.duration",
         "is of unstable = \"move\"");
}

TEST_CASE("what the Galerkin plate has not is refused with the reason, and what it needs not may stay") {
  const auto galerkin = [](const std::string& line) {
    return with_line(plain, 9, "spacing = 0.05\nformulation = \"galerkin\"\n" + line);
  };
  CHECK(read(galerkin("surface_correction = \"position_aware\"\nhorizon_ratio = 3.015"))
            .content.discretization.formulation == &plate::galerkin);
  expect(galerkin("surface_correction = \"none\""), ":11", "discretization.surface_correction",
         "nothing is to be corrected");
  expect(galerkin("influence = \"constant\""), ":11", "discretization.influence", "points of the cells");
  expect(galerkin("twist_match = \"paper\""), ":11", "discretization.twist_match", "need no calibration");
  expect(with_line(plain, 9, "spacing = 0.05\nformulation = \"ordinary\"\ntip_spacing = 0.01"), ":11",
         "discretization.tip_spacing", "with formulation = galerkin only");
  expect(with_line(galerkin(""), 13, "kind = \"clamped_layer\""), ":13", "support[0].kind",
         "whose points lie on the edges");
  expect(galerkin("") + "\n", "--set analysis.preconditioner", "analysis.preconditioner", "formulation = \"ordinary\"",
         {"analysis.preconditioner=\"two_level\""});
  expect(plain, "--set analysis.preconditioner", "analysis.preconditioner", "formulation = \"galerkin\"",
         {"analysis.preconditioner=\"levels\"", "discretization.formulation=ordinary"});
}

TEST_CASE("mixed precision is for motions, and not for plates so thin that rounding would show") {
  const auto with = [](const char* thickness, const char* analysis) {
    return with_line(with_line(plain, 17, analysis), 4, std::string("density = 1\nthickness = ") + thickness);
  };
  const char* const motion = "kind = \"dynamic\"\nduration = 1\nprecision = \"mixed\"";
  CHECK(read(with("0.1", motion)).content.analysis.precision == cases::Analysis::Precision::mixed);
  expect(with("0.001", motion), ":20", "analysis.precision", "above 0.3; choose \"double\"");
  expect(with("0.1", "kind = \"static\"\nprecision = \"mixed\""), ":19", "analysis.precision", "dynamics only");
}

TEST_CASE("missing keys are reported at their table") {
  expect(with_line(plain, 2, ""), ":1", "section.young", "is missing, must be a number > 0");
  expect(with_line(plain, 6, ""), ":5", "geometry.outline", "is missing");
  expect(with_line(plain, 9, ""), ":8", "discretization.spacing", "is missing");
  expect(with_line(plain, 12, ""), ":10", "support[0].edges", "is missing");
  expect(with_line(plain, 15, ""), ":13", "load[0].value", "is missing");
  expect(with_line(plain, 17, ""), ":16", "analysis.kind", "is missing");
}

TEST_CASE("a frequency analysis needs a density and no load") {
  const std::string kind = with_line(plain, 17, "kind = \"frequencies\"");
  const std::string dense = with_line(kind, 4, "thickness = 0.1\ndensity = 1");
  expect(dense, ":14", "load", "load is used in statics and dynamics only");
  const std::string frequencies = with_line(with_line(with_line(dense, 14, ""), 15, ""), 16, "");
  CHECK(problems(frequencies).empty());
  expect(with_line(frequencies, 5, ""), ":1", "section.density", "is missing");
  expect(frequencies, "--set analysis.method", "analysis.method", "must be \"lanczos\" in frequencies",
         {"analysis.method=cg"});
  expect(frequencies, "--set analysis.duration", "analysis.duration", "in dynamics only", {"analysis.duration=1"});
  expect(frequencies, "--set analysis.modes", "analysis.modes", "an integer in [1, 1000]", {"analysis.modes=0"});
  expect(frequencies, "--set output.every", "output.every", "in dynamics only", {"output.every=1"});
  expect(frequencies, "--set output.probes", "output.probes", "in statics and dynamics only",
         {"output.probes={a=[0, 0.5]}"});
  expect(frequencies, "--set srif.skip", "srif", "in statics and dynamics only", {"srif.skip=1"});
}

TEST_CASE("keys of the other kind of analysis are refused") {
  const auto analysis = [](const std::string& lines) { return with_line(plain, 17, lines); };
  expect(analysis("kind = \"static\"\nduration = 1"), ":18", "analysis.duration",
         "analysis.duration is used in dynamics only");
  expect(analysis("kind = \"static\"\nmethod = \"central_difference\""), ":18", "analysis.method",
         "must be \"cg\" or \"adr\" or \"direct\"");
  expect(with_line(plain, 15, "value = 1\nhistory = \"step\""), ":16", "load[0].history", "in dynamics only");
  expect(plain + "[output]\nevery = 1\n", ":19", "output.every", "in dynamics only");
  const std::string dynamic =
      with_line(analysis("kind = \"dynamic\"\nduration = 1"), 4, "thickness = 0.1\ndensity = 1");
  CHECK(problems(dynamic).empty());
  expect(dynamic, "--set analysis.tolerance", "analysis.tolerance", "is of method = \"lanczos\"",
         {"analysis.tolerance=1e-6"});
  expect(dynamic, "--set analysis.method", "analysis.method", "must be \"central_difference\"",
         {"analysis.method=adr"});
  expect(analysis("kind = \"dynamic\"\nduration = 1"), ":1", "section.density", "is missing");
  expect(analysis("kind = \"static\"\nmodes = 3"), ":18", "analysis.modes", "in frequencies only");
  expect(with_line(dynamic, 19, ""), ":17", "analysis.duration", "is missing");
  expect(dynamic, "--set load[0].rise_time", "load[0].rise_time", "with history = ramp only", {"load[0].rise_time=1"});
  expect(dynamic, ":14", "load[0].rise_time", "is missing", {"load[0].history=ramp"});
  expect(dynamic, "--set load[0].history", "load[0].history", "must ascend", {"load[0].history=[[0, 1], [0, 2]]"});
  expect(dynamic, "--set load[0].history", "load[0].history", "did you mean 'step'?", {"load[0].history=stop"});
  expect(dynamic, "--set analysis.time_step", "analysis.time_step", "\"auto\" or a number > 0",
         {"analysis.time_step=0"});
}

TEST_CASE("all problems of a file are reported together, in the order of its lines") {
  std::string text = with_line(with_line(plain, 3, "poisson = 0.7"), 9, "spacing = 0.05\nhorizn = 3");
  text = with_line(with_line(text, 13, "edges = [\"lefd\"]"), 18, "kind = \"static\"\nduration = 1");
  const auto found = problems(text, {"section.young=-1"});
  REQUIRE(found.size() == 5);
  CHECK(found[0].place == "--set section.young");
  CHECK(found[1].place == ":3");
  CHECK(found[2].place == ":10");
  CHECK(found[3].place == ":13");
  CHECK(found[4].place == ":19");
  const cases::CaseError error({{"a.toml:3", "section.poisson", "0.7 given"}, {"a.toml:10", "", "what"}});
  CHECK(std::string(error.what()) == "a.toml:3: section.poisson: 0.7 given\na.toml:10: what");
}

TEST_CASE("files that cannot be read and syntax errors name the place") {
  CHECK_THROWS_WITH(cases::read_case("/no/such/case.toml", {}), Catch::Contains("/no/such/case.toml: no such file"));
  CHECK_THROWS_WITH(cases::read_case(std::filesystem::temp_directory_path(), {}), Catch::Contains("cannot be read"));
  const auto found = problems(with_line(plain, 3, "poisson = "));
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].place, Catch::StartsWith(":3:"));
  CHECK_FALSE(found[0].what.empty());
}
