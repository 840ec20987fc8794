#include "cases/input/validation.hpp"

#include "plate/formulations.hpp"
#include "tests/catch.hpp"

using plate::Load;
using plate::Problem;

namespace {

Load of(double value) {
  return {plate::Pressure{.value = value}};
}

Problem of_formulation() {
  Problem result;
  result.discretization.formulation = plate::formulations().front();
  return result;
}

std::vector<std::string> errors(const plate::Problem& problem) {
  std::vector<std::string> result;
  for (const auto& [key, what] : cases::errors_in_load_cases(problem)) result.push_back(key + ": " + what);
  return result;
}

}  // namespace

TEST_CASE("errors in load cases: what is wrong with names, loads and sums is said at once") {
  Problem bad = of_formulation();
  bad.load_cases = {{"a", {of(3)}}, {"a", {of(1)}}, {"b", {}}};
  bad.combinations = {{"b", {{"a", 1}, {"d", 2}}}, {"c", {}}, {"e", {{"b", INFINITY}}}};
  join_loads(bad);
  CHECK(errors(bad) ==
        std::vector<std::string>{"case[1].name: \"a\" is the name of case[0] already",
                                 "combination[0].name: \"b\" is the name of case[2] already",
                                 "case[2]: nothing loads the plate in it: give it a [[case.load]]",
                                 "combination[0].of.d: \"d\" is no load case" + std::string(" (did you mean 'a'?)"),
                                 "combination[1].of: names no load case: give { name = factor, ... }",
                                 "combination[2].of.b: must be finite"});
  Problem alone = of_formulation();
  alone.combinations = {{"c", {}}};
  CHECK(errors(alone).size() == 2);  // of nothing, and there is nothing
  auto shared = of_formulation();
  shared.loads = {of(1)};
  shared.load_cases = {{"a", {of(3)}}};
  join_loads(shared);
  CHECK(errors(shared).empty());
  shared.combinations = {{"d", {{"a", 1}}}};
  REQUIRE(errors(shared).size() == 1);
  CHECK_THAT(errors(shared)[0], Catch::Contains("count these as often as its factors say"));
}
