#include "plate/model/problem.hpp"

#include "tests/catch.hpp"

using namespace plate;

namespace {

Load of(double value) {
  return {Pressure{.value = value}};
}

/// Two loads that all share, then one of the first load case and two of the third.
Problem problem() {
  Problem result;
  result.loads = {of(1), of(2)};
  result.load_cases = {{"a", {of(3)}}, {"b", {}}, {"c", {of(4), of(5)}}};
  join_loads(result);
  return result;
}

std::vector<std::string> errors(const Problem& problem) {
  std::vector<std::string> result;
  for (const auto& [key, what] : errors_in_load_cases(problem)) result.push_back(key + ": " + what);
  return result;
}

}  // namespace

TEST_CASE("load cases: their loads stand behind those that all share") {
  const auto all = problem();
  REQUIRE(all.loads.size() == 5);
  CHECK(shared_loads(all) == 2);
  CHECK(loads_of(all, 0) == std::vector<std::size_t>{0, 1, 2});
  CHECK(loads_of(all, 1) == std::vector<std::size_t>{0, 1});
  CHECK(loads_of(all, 2) == std::vector<std::size_t>{0, 1, 3, 4});
  CHECK(key_of_load(all, 1) == "load[1]");
  CHECK(key_of_load(all, 2) == "case[0].load[0]");
  CHECK(key_of_load(all, 4) == "case[2].load[1]");
  CHECK(errors(all).empty());
}

TEST_CASE("load cases: what is wrong with names, loads and sums is said at once") {
  Problem bad;
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
  Problem alone;
  alone.combinations = {{"c", {}}};
  CHECK(errors(alone).size() == 2);  // of nothing, and there is nothing
  auto shared = problem();
  shared.combinations = {{"d", {{"a", 1}}}};
  REQUIRE(errors(shared).size() == 1);
  CHECK_THAT(errors(shared)[0], Catch::Contains("count these as often as its factors say"));
}

TEST_CASE("load cases: factors of a combination, own weight and larger loads") {
  CHECK(factors_of({"d", {{"c", 2}, {"a", -1}}}, problem().load_cases) == std::vector<double>{-1, 0, 2});
  Problem heavy;
  heavy.section = {1, 0.3, 0.2, 5.0 / 6, 0};
  heavy.loads = {of(7), of(0)};
  heavy.loads[1].as<Pressure>()->gravity = -10;
  CHECK(resolve_weights(heavy) == 1);
  heavy.section.density = 2500;
  CHECK_FALSE(resolve_weights(heavy));
  CHECK(heavy.loads[0].as<Pressure>()->value == 7);
  CHECK(heavy.loads[1].as<Pressure>()->value == Approx(-5000));
  scale(heavy.loads[1], 2);
  CHECK(heavy.loads[1].as<Pressure>()->value == Approx(-10000));
  CHECK(heavy.loads[1].as<Pressure>()->gravity);
  Load growing{Pressure{.value = 1, .gradient = {2, 3}}};
  scale(growing, 0.5);
  CHECK(growing.as<Pressure>()->at({1, 1}) == Approx(3));
  Load by_formula{Pressure{.formula = Formula("x + y")}};
  scale(by_formula, -3);
  CHECK(by_formula.as<Pressure>()->at({1, 2}) == Approx(-9));
}
