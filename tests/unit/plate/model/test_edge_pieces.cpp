#include "plate/model/load_integration.hpp"

#include <numbers>

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"

using namespace plate;

TEST_CASE("pieces of edges have their length and outward normals, and points beside them") {
  auto outline = geometry::rectangle(0, 0, 1.2, 1);
  outline.holes.push_back(geometry::Circle{{0.6, 0.5}, 0.2, "hole0"});
  const auto cloud = geometry::lattice(outline, 0.1);
  const auto sums = [&](const std::string& name) {
    double length = 0, outward = 0;
    for (const auto& border : edge_borders(name, cloud, outline))
      for (const auto& [middle, normal] : border.pieces) {
        length += normal.norm();
        outward += normal.dot(middle - cloud.positions[nearest(border.near, cloud, middle)]) > 0;
      }
    return std::pair(length, outward);
  };
  const auto [right, out_of_right] = sums("right");
  CHECK(right == Approx(1).epsilon(1e-12));
  CHECK(out_of_right == 80);
  CHECK(sums("hole0").first == Approx(0.4 * std::numbers::pi).epsilon(1e-12));  // arcs
  CHECK(edge_borders("none", cloud, outline).empty());
}
