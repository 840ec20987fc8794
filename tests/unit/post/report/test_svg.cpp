#include "post/report/svg.hpp"

#include <set>

#include "tests/catch.hpp"

using post::svg::Look, post::svg::mark;

TEST_CASE("the looks of many series differ in their marks or their lines") {
  std::set<std::string> found;
  for (std::size_t number = 0; number < 18; ++number) {
    const Look look(number);
    found.insert(look.stroke() + mark(0, 0, look));
  }
  CHECK(found.size() == 18);
  for (std::size_t number = 0; number < 36; ++number) found.insert(mark(0, 0, Look(number)));  // without lines
  CHECK(found.size() == 18 + 36);
}
