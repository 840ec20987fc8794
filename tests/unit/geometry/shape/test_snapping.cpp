#include "geometry/shape/crack_cleanup.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace geometry;

namespace {

Outline snapped_plate() {
  auto outline = rectangle(0, 0, 4, 3);
  outline.holes.push_back(Circle{{2, 1.5}, 0.5, "hole0"});
  return outline;
}

std::vector<End> ends(const std::vector<Polyline>& cracks) {
  std::vector<End> result;
  for (const auto& path : crack_paths(snapped_plate(), cracks, tolerance(snapped_plate())))
    result.insert(result.end(), {path.front, path.back});
  return result;
}

}  // namespace

TEST_CASE("snapping: ends beside a hole, on either side of it, become mouths at any angle") {
  for (int degrees = 0; degrees < 360; degrees += 15)
    for (const double off : {-4e-6, 3e-6}) {
      const Point n(std::cos(degrees * 0.017453), std::sin(degrees * 0.017453)), centre(2, 1.5);
      const std::vector<Polyline> cracks{{centre + (0.5 + off) * n, centre + 0.9 * n}};
      const auto found = snapped(snapped_plate(), cracks, 1e-3);
      REQUIRE(found.snaps.size() == 1);
      CHECK(found.snaps[0].onto == "hole0");
      CHECK(found.snaps[0].distance == Approx(std::abs(off)).epsilon(1e-6));
      CHECK((found.cracks[0][0] - cracks[0][0]).norm() < 5e-6);
      CHECK(ends(found.cracks) == std::vector{End::mouth, End::tip});
    }
}

TEST_CASE("snapping: what touches already, or is farther than a thousandth of the segment or the reach, stays") {
  const std::vector<Polyline> there{{{0, 1}, {1, 1}}};
  CHECK(snapped(snapped_plate(), there, 1).snaps.empty());
  const std::vector<Polyline> off{{{5e-4, 1}, {1, 1}}};
  CHECK(snapped(snapped_plate(), off, 1).snaps.size() == 1);
  CHECK(snapped(snapped_plate(), off, 4e-4).snaps.empty());
  CHECK(snapped(snapped_plate(), {{{2e-3, 1}, {1, 1}}}, 1).snaps.empty());
  CHECK(snapped(snapped_plate(), off, 4e-4).cracks == off);
  CHECK(snapped(snapped_plate(), {{}, {{1, 1}}}, 1).snaps.empty());
}

TEST_CASE("snapping: two ends that mean the same point meet, and the branch of a crack joins it") {
  const auto kink = snapped(snapped_plate(), {{{0.5, 0.5}, {1, 0.5}}, {{1, 0.500004}, {1.4, 0.8}}}, 1e-3);
  REQUIRE(kink.snaps.size() == 1);
  CHECK(kink.cracks[0].back() == kink.cracks[1].front());
  const auto branch = snapped(snapped_plate(), {{{0.5, 2.5}, {3.5, 2.5}}, {{1, 2.500003}, {1.2, 2.8}}}, 1e-3);
  REQUIRE(branch.snaps.size() == 1);
  CHECK(branch.snaps[0].onto == "cracks[0]");
  CHECK(ends(branch.cracks) == std::vector{End::tip, End::tip, End::junction, End::tip});
}
