#include "geometry/cells/tessellation.hpp"

#include <random>

#include "tests/catch.hpp"

using namespace geometry;

TEST_CASE("locator: the cell about a place, whose weights show linear fields as they are") {
  auto outline = rectangle(0, 0, 1.3, 0.9);
  outline.holes.push_back(Circle{{0.62, 0.41}, 0.17, "hole"});
  const auto paths = crack_paths(outline, {{{0, 0.2}, {0.3, 0.31}}}, 1e-9);
  for (const auto& cells :
       {tessellation(outline, paths, 0.1, {}, {}), tessellation(outline, paths, 0.1, {}, {0.01, {}, 0.4})}) {
    const CellLocator locate(cells);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(0, 1.3), y(0, 0.9);
    for (int i = 0; i < 400; ++i) {
      const Point at(x(random), y(random));
      if ((at - Point(0.62, 0.41)).norm() < 0.18) continue;
      const auto found = locate(at, at);
      Point sum(0, 0);
      double weight = 0, least = 1;
      for (std::size_t n = 0; n < found.count; ++n) {
        sum += found.weights[n] * cells.positions[found.points[n]], weight += found.weights[n];
        least = std::min(least, found.weights[n]);
      }
      CAPTURE(at.transpose());
      CHECK(weight == Approx(1));
      CHECK((sum - at).norm() < 1e-12);
      CHECK(least > -1e-9);  // it is about the place
    }
    const auto outside = locate({-3, 20}, {0.05, 0.88});  // nearest: in the corner
    for (std::size_t n = 0; n < outside.count; ++n)
      CHECK((cells.positions[outside.points[n]] - Point(0, 0.9)).norm() < 0.5);
  }
}
