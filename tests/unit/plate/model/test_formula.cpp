#include "plate/model/formula.hpp"

#include <cmath>

#include "tests/catch.hpp"

using plate::Formula;

namespace {

/// What a text that is no formula is told.
std::string refusal(const std::string& text) {
  const auto found = Formula::parsed(text);
  const auto* error = std::get_if<std::string>(&found);
  return error ? *error : "";
}

}  // namespace

TEST_CASE("formula: an expression in x, y and pi") {
  const Formula waves("100 * sin(pi * x / 2) * cos(y) + (x > 0.2 ? 1 : 0)");
  for (const geometry::Point& at : {geometry::Point(0.1, 0.7), geometry::Point(-3, 2), geometry::Point(0.9, -1)})
    CHECK(waves(at) == Approx(100 * std::sin(M_PI * at.x() / 2) * std::cos(at.y()) + (at.x() > 0.2 ? 1 : 0)));
  CHECK(waves.given());
  CHECK(waves.text().starts_with("100 * sin"));
  CHECK_FALSE(Formula().given());
  CHECK(Formula().text().empty());
  const Formula copy = waves, other("x - y");  // each has its own place
  CHECK(other({1, 2}) == -1);
  CHECK(copy({1, 0}) == Approx(101));
  CHECK(Formula("x <= 1 && y != 2")({0, 0}) == 1);
}

TEST_CASE("formula: what has no value somewhere says so where it is asked") {
  CHECK_FALSE(std::isfinite(Formula("1 / x")({0, 0})));
  CHECK_FALSE(std::isfinite(Formula("sqrt(x)")({-1, 0})));
  CHECK_FALSE(std::isfinite(Formula("ln(x)")({0, 0})));
  CHECK(Formula("1 / x")({2, 0}) == 0.5);
  CHECK_THAT(plate::FormulaError(Formula("1 / x"), {0, 3}).what(), Catch::Contains("\"1 / x\" is inf at (0, 3)"));
}

TEST_CASE("formula: text that is none is refused with the place") {
  CHECK_THAT(refusal("3 * z + 1"), Catch::Contains("\"z\" at character"));
  CHECK_THAT(refusal("sin(x"), Catch::Contains("character"));
  CHECK_THAT(refusal("2 * (x + "), !Catch::Equals(""));
  CHECK_THAT(refusal(""), !Catch::Equals(""));
  CHECK_THAT(refusal("x = 3"), Catch::Contains("'=' at character 3"));
  CHECK_THAT(refusal("x += 3"), !Catch::Equals(""));
  CHECK_THAT(refusal("x, y"), Catch::Contains("2 expressions"));
  CHECK(refusal("x == 3").empty());
  CHECK(std::get<Formula>(Formula::parsed("x + 1"))({2, 0}) == 3);
  CHECK_THROWS_AS(Formula("sin(x"), std::invalid_argument);
}
