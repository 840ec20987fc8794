#include "cases/input/problems.hpp"
#include "tests/catch.hpp"

TEST_CASE("problems: a key that was not given has the place of its nearest parent") {
  const cases::Source source{{{"", "a.toml"}, {"support", "a.toml:7"}, {"support[1].edges", "--set support[1].edges"}}};
  CHECK(source.place("support[1].edges") == "--set support[1].edges");
  CHECK(source.place("support[1].edges[2]") == "--set support[1].edges");
  CHECK(source.place("support[0].edges") == "a.toml:7");
  CHECK(source.place("section.young") == "a.toml");
}

TEST_CASE("problems: all of them in one message, a line each") {
  const cases::CaseError error({{"a.toml:1", "section.young", "is missing"}, {"b.toml", "", "no such file"}});
  CHECK(error.what() == std::string("a.toml:1: section.young: is missing\nb.toml: no such file"));
  CHECK(error.problems().size() == 2);
}
