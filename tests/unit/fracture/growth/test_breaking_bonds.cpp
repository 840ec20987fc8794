#include "fracture/growth/moving_bonds_and_tips.hpp"
#include "tests/catch.hpp"

using namespace fracture;

TEST_CASE("breaking bonds: one bond of each family breaks at once, and those that are loaded alike") {
  const auto broken =
      first_to_break({{{1, 2}, 3.0}, {{2, 5}, 2.5}, {{3, 4}, 2.0}, {{3, 6}, 2.0 * (1 - 1e-8)}, {{5, 7}, 1.5}});
  REQUIRE(broken.size() == 4);
  CHECK(broken[0].bond == PointPair{1, 2});
  CHECK(broken[1].bond == PointPair{3, 4});
  CHECK(broken[2].bond == PointPair{3, 6});
  CHECK(broken[3].bond == PointPair{5, 7});
}
