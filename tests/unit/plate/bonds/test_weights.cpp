#include "plate/bonds/horizon_parameters.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;

TEST_CASE("family kinds: points are of one kind where bonds, areas and what they store are equal, and nowhere else") {
  auto d = small_plate::spaced(1);
  auto outline = geometry::rectangle(0, 0, 9, 8);
  outline.outer.vertices[2] = {7.6, 8};  // cells that an edge cuts
  const auto m = small_plate::model(outline, {{SupportKind::clamped, {"left"}, {}}}, d,
                                    {{{{0, 4}, {4, 4}}, geometry::End::mouth, geometry::End::tip}});
  const auto& families = m.plate.families();
  const auto& areas = m.boundary.cloud.areas;
  const auto kinds = family_kinds(families, areas, m.boundary.active);
  const auto described = [&](std::size_t k) {
    std::vector<std::array<double, 3>> result{{areas[k], double(m.boundary.active[k]), 0}};
    for (const auto& bond : families[k]) {
      const auto& x = families.vectors()[bond.vector_id];
      result.push_back({x.x(), x.y(), areas[bond.neighbour]});
    }
    return result;
  };
  REQUIRE(kinds.kind.size() == families.points());
  std::map<std::vector<std::array<double, 3>>, std::uint32_t> found;
  for (std::size_t k = 0; k < families.points(); ++k) {
    const auto [entry, fresh] = found.try_emplace(described(k), kinds.kind[k]);
    CHECK(entry->second == kinds.kind[k]);
    if (fresh) CHECK(kinds.example[kinds.kind[k]] == k);
  }
  CHECK(found.size() == kinds.example.size());
  CHECK(found.size() < families.points());
}
