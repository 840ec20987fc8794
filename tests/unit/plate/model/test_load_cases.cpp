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

}  // namespace

TEST_CASE("load cases: their loads stand behind those that all share") {
  const auto all = problem();
  REQUIRE(all.loads.size() == 5);
  CHECK(shared_loads(all) == 2);
  CHECK(loads_of(all, 0) == std::vector<std::size_t>{0, 1, 2});
  CHECK(loads_of(all, 1) == std::vector<std::size_t>{0, 1});
  CHECK(loads_of(all, 2) == std::vector<std::size_t>{0, 1, 3, 4});
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
