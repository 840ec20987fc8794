#include "post/factors/tip_integrals.hpp"

#include "geometry/shape/crack_path.hpp"
#include "tests/catch.hpp"

using namespace post;

TEST_CASE("rings keep clear of edges, other cracks, other tips and bends") {
  const auto outline = geometry::rectangle(0, 0, 60, 60);
  const auto clear = [&](const std::vector<geometry::Polyline>& cracks) {
    const auto paths = geometry::crack_paths(outline, cracks, 1e-9);
    return clear_distance(outline, paths, geometry::tips(paths).back(), 1);
  };
  CHECK(clear({{{0, 30}, {30, 30}}}) == Approx(30));
  CHECK(clear({{{20, 30}, {30, 30}}}) == Approx(7));            // 0.7 of the way to the other tip
  CHECK(clear({{{0, 30}, {20, 20}, {30, 20}}}) == Approx(10));  // the bend
  CHECK(clear({{{0, 40}, {60, 40}}, {{0, 30}, {30, 30}}}) == Approx(10));
  CHECK(clear({{{0, 30}, {52, 30}}}) == Approx(8));
  CHECK(rings(30, 1, false).size() == 4);
  CHECK(rings(30, 1, false).front().outer == 16);
  CHECK(rings(9.7, 1, false).front().outer == Approx(9.2));
  CHECK(rings(5.5, 1, false).front().outer == Approx(5));
  CHECK(rings(4.4, 1, false).empty());
  CHECK(rings(4.4, 1, true).empty());
  CHECK(rings(30, 0.01, true).front().outer == Approx(18));
}
