#include "cases/input/key_forms.hpp"
#include "tests/catch.hpp"

TEST_CASE("field: bounds in words") {
  CHECK(cases::finite.text(false) == "a finite number");
  CHECK(cases::positive.text(false) == "a number > 0");
  CHECK(cases::Bounds{1, 10}.text(true) == "an integer in [1, 10]");
  CHECK(cases::Bounds{-1, 0.5, true, true}.text(false) == "a number in (-1, 0.5)");
  CHECK_FALSE(cases::positive.contain(0));
}

TEST_CASE("field: kinds of analysis in words") {
  CHECK(cases::analyses({plate::Analysis::Kind::static_, plate::Analysis::Kind::frequencies}) ==
        "statics and frequencies");
  CHECK(cases::kind_names(cases::any_kind) == "static, dynamic, frequencies, harmonic, buckling");
}
