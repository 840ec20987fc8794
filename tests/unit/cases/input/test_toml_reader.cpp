#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("unknown keys are named with the nearest known one") {
  expect(with_line(plain, 9, "spacing = 0.05\nhorizn = 3"), ":10", "discretization.horizn",
         "did you mean 'horizon_ratio'?");
  expect(with_line(plain, 9, "spacing = 0.05\nspcing = 3"), ":10", "discretization.spcing", "did you mean 'spacing'?");
  expect(with_line(plain, 4, "thickness = 0.1\nhorizon_ratio = 3"), ":5", "section.horizon_ratio",
         "did you mean 'discretization.horizon_ratio'?");
  expect(with_line(plain, 4, "thickness = 0.1\nqqqqqq = 3"), ":5", "section.qqqqqq",
         "known here: orthotropic, plies, young, poisson");
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

TEST_CASE("missing keys are reported at their table") {
  expect(with_line(plain, 2, ""), ":1", "section.young", "is missing, must be a number > 0");
  expect(with_line(plain, 6, ""), ":5", "geometry.outline", "is missing");
  expect(with_line(plain, 9, ""), ":8", "discretization.spacing", "is missing");
  expect(with_line(plain, 12, ""), ":10", "support[0].edges", "nothing is held: give edges");
  expect(with_line(plain, 15, ""), ":13", "load[0].value", "is missing");
  expect(with_line(plain, 17, ""), ":16", "analysis.kind", "is missing");
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
