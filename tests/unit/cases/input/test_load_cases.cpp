#include "tests/unit/cases/case_text.hpp"

#include "cases/driver/prepared.hpp"
#include "plate/formulation/discretised.hpp"

using namespace case_text;

namespace {

const std::string two = plain + R"([[case]]
name = "dead"
[[case.load]]
kind = "pressure"
gravity = -10.0
[[case]]
name = "wind"
load = [{ kind = "pressure", value = 2.0, on = { circle = [0.5, 0.5, 0.2] } }, { kind = "point_force", value = 1, position = [0.2, 0.3] }]
)";

const std::vector<std::string> heavy{"section.density=3.0"};

}  // namespace

TEST_CASE("keys of load cases: their loads are those of [[load]], and are written as they were given") {
  const auto file = read(two, heavy);
  const auto& c = file.content;
  REQUIRE(c.loads.size() == 4);
  REQUIRE(c.load_cases.size() == 2);
  CHECK(c.load_cases[1].loads.size() == 2);
  CHECK(c.loads[1].as<plate::Pressure>()->value == Approx(-3.0));
  const auto again = read(cases::resolved_toml(c)).content;
  CHECK(again.loads.size() == 4);
  CHECK(again.load_cases[1].loads[0].as<plate::Pressure>()->patch.has_value());
  CHECK(cases::resolved_toml(again) == cases::resolved_toml(c));
}

TEST_CASE("keys of load cases: problems are at the load, all in one message") {
  auto bad = two;
  bad += "[[combination]]\nname = \"dead\"\nof = { dead = 1.35, wnd = 1.5 }\n";
  const auto found = problems(bad, {"section.density=3.0", "load=[]", "case[1].load[1].position=[3,0]"});
  std::vector<std::string> keys;
  for (const auto& one : found) keys.push_back(one.key);
  CHECK(std::ranges::find(keys, "combination[0].name") != keys.end());
  CHECK(std::ranges::find(keys, "combination[0].of.wnd") != keys.end());
  CHECK(std::ranges::find(keys, "case[1].load[1].position") != keys.end());
  CHECK(keys.size() == 3);
  expect(two, ":1", "section.density", "case[0].load[0] is the plate's own weight");
  expect(plain + "[[case]]\nname = \"a b\"\n", ":19", "case[0].name", "letters, digits");
  expect(plain + "[[case]]\nname = \"a\"\n[growth]\nfracture_energy = 1\n", ":20", "growth", "share no plate");
  expect(plain + "[[case]]\nname = \"a\"\n", "--set srif.accuracy", "srif.accuracy", "for one load",
         {"srif.accuracy=0.01"});
  expect(plain + "[[combination]]\nname = \"a\"\nof = { b = 1 }\n", ":18", "combination", "no [[case]]");
}

TEST_CASE("keys of loads: expressions and own weight stand for the value") {
  const auto load = [](const std::string& lines) { return with_line(plain, 15, lines); };
  CHECK(problems(load("expression = \"sin(pi * x) * y\"")).empty());
  CHECK(read(load("expression = \"x + 2\"")).content.loads[0].as<plate::Pressure>()->at({1, 0}) == 3);
  expect(load("expression = \"x + z\""), ":15", "load[0].expression", "\"z\" at character");
  expect(load("expression = \"x\"\nvalue = 1"), ":16", "load[0].value",
         "neither body_force, expression, table nor gravity only");
  expect(load("expression = \"x\"\ngradient = [1, 0]"), ":16", "load[0].gradient", "with a value, without level only");
  expect(load("expression = \"x\"\ngravity = 1"), ":16", "load[0].gravity", "without expression and table only", heavy);
  expect(load("gravity = 9.81"), ":1", "section.density", "is missing");
  CHECK(problems(load("gravity = 9.81"), heavy).empty());
  const auto again = read(cases::resolved_toml(read(load("gravity = 9.81"), heavy).content)).content;
  CHECK(again.loads[0].as<plate::Pressure>()->value == Approx(3.0 * 0.1 * 9.81));
  const auto file = read(load("expression = \"1 / (y - y)\""));
  try {
    cases::discretised(file);
    FAIL("a pressure without a value is taken");
  } catch (const cases::CaseError& error) {
    CHECK(error.problems().at(0).key == "load[0].expression");
    CHECK_THAT(error.problems().at(0).what, Catch::Contains("\"1 / (y - y)\" is inf at (-0."));
  }
}
