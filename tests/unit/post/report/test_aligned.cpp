#include "post/files/table.hpp"
#include "tests/catch.hpp"

TEST_CASE("columns are aligned by characters, numbers to the right, and lines end without blanks") {
  CHECK(post::aligned({{"L\u00e4nge", false, {"\u00e4", "bb"}}, {"n", true, {"1", "100"}}, {"", false, {"", ""}}}) ==
        "L\u00e4nge    n\n\u00e4        1\nbb     100\n");
  CHECK(post::aligned({}).empty());
  CHECK(post::aligned({{"alone", false, {}}}) == "alone\n");
}
