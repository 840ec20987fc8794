#include "geometry/lattice/grouped.hpp"

#include <algorithm>
#include <utility>

#include "tests/catch.hpp"

TEST_CASE("groups have their values in the order in which these come") {
  const std::vector<std::pair<std::size_t, int>> values{{2, 7}, {0, 5}, {2, 3}, {0, 5}, {2, 9}};
  const geometry::Grouped<int> grouped(4, [&](const auto& visit) {
    for (const auto& [group, value] : values) visit(group, value);
  });
  CHECK(std::ranges::equal(grouped[0], std::vector{5, 5}));
  CHECK(grouped[1].empty());
  CHECK(std::ranges::equal(grouped[2], std::vector{7, 3, 9}));
  CHECK(grouped[3].empty());
}
