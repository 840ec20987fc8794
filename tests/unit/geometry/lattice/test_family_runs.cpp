#include "geometry/lattice/families.hpp"

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"

using namespace geometry;

TEST_CASE("family runs: every point in one, alike to the first of its pattern, and none too long") {
  auto outline = rectangle(0, 0, 60, 16);
  outline.holes.push_back(Circle{{12, 5}, 1.6, "hole"});
  const auto cloud = lattice(outline, 1);
  const auto all = families(cloud, 3.015, [](auto, auto) { return true; });
  std::vector<std::uint32_t> kind(cloud.size(), 0);
  for (std::uint32_t k = 0; k < kind.size(); ++k) kind[k] = all.pattern(k);
  const auto look = [&](std::uint32_t k) {  // steps in the numbering, and kinds
    std::vector<std::array<std::int64_t, 2>> result{{0, kind[k]}};
    for (const auto& bond : all[k]) result.push_back({std::int64_t(bond.neighbour) - k, kind[bond.neighbour]});
    return result;
  };
  for (const std::uint32_t longest : {1u, 7u, 1000u}) {
    const auto found = family_runs(all, kind, longest);
    std::uint32_t next = 0;
    for (const auto& run : found.runs) {
      CHECK(run.first_point == next);
      CHECK(run.length >= 1);
      CHECK(run.length <= longest);
      next += run.length;
      for (auto k = run.first_point; k < next; ++k) CHECK(look(k) == look(found.example[run.pattern]));
    }
    CHECK(next == cloud.size());
    if (longest == 1000) CHECK(found.runs.size() < cloud.size() / 2);  // rows inside are whole
  }
}
