#include "cases/input/manual.hpp"
#include "tests/catch.hpp"

using cases::dotted, cases::steps;

TEST_CASE("a dotted key has its steps, however its indices are written") {
  for (const std::string key : {"load[0].value", "load.0.value", " load [0] . value"}) {
    const auto path = steps(key);
    REQUIRE(path.size() == 3);
    CHECK(std::get<std::string>(path[0]) == "load");
    CHECK(std::get<std::size_t>(path[1]) == 0);
    CHECK(dotted(path) == "load[0].value");
  }
  CHECK(steps("").empty());
  CHECK(dotted(steps("0.a")) == "0.a");  // a table's name, not an index, comes first
}
