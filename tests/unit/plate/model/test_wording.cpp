#include "plate/model/wording.hpp"

#include <cstdlib>
#include <cstring>
#include <random>

#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("wording: the candidate nearest to a word, whatever its case, by its beginning too") {
  const std::vector<std::string> keys{"spacing", "horizon_ratio", "kind"};
  CHECK(did_you_mean("spcaing", keys) == " (did you mean 'spacing'?)");  // neighbours exchanged: one edit
  CHECK(did_you_mean("SPACING", keys) == " (did you mean 'spacing'?)");
  CHECK(did_you_mean("horizn", keys) == " (did you mean 'horizon_ratio'?)");
  CHECK(did_you_mean("qqqqqq", keys).empty());
  CHECK(did_you_mean("spacing", {}).empty());
}

TEST_CASE("wording: names and words without a letter are compared too") {
  CHECK(did_you_mean("left", {""}).empty());
  CHECK(did_you_mean("lefd", {"", "left"}) == " (did you mean 'left'?)");
  CHECK(did_you_mean("", {"spacing"}).empty());
  CHECK(did_you_mean("", {""}).empty());
}

TEST_CASE("wording: the text of a number reads as the same number, and none is shorter") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    const auto bits = random();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x)) continue;
    const auto text = number_text(x);
    CHECK(std::strtod(text.c_str(), nullptr) == x);
    CHECK(text.size() <= 24);  // -1.2345678901234567e-308
  }
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-0.0) == "0");
  CHECK(number_text(1e22) == "1e+22");
}

TEST_CASE("wording: what a string of TOML may not hold is escaped") {
  CHECK(quoted("a \"b\" \\ c\n\x7f") == R"("a \"b\" \\ c\u000A\u007F")");
  CHECK(quoted("ä") == "\"ä\"");
  CHECK(listed({"a", "b"}) == R"("a", "b")");
  CHECK(text_of(std::vector<std::string>{}) == "[]");
  CHECK(text_of(std::vector<geometry::Point>{{1, -0.0}, {0.5, 2}}) == "[[1, 0], [0.5, 2]]");
}
