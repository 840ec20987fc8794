#include "plate/formulation/tip_view.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

TEST_CASE("ring: its extension falls from 1 to 0 by the slope that it states") {
  const Ring ring{2, 5};
  CHECK(ring.extension(0) == 1);
  CHECK(ring.extension(ring.inner) == 1);
  CHECK(ring.extension(ring.outer) == 0);
  CHECK(ring.extension(100) == 0);
  double fallen = 0;  // Simpson's rule
  constexpr int pieces = 300;
  for (int i = 0; i < pieces; ++i) {
    const double from = 1 + 5.0 * i / pieces, step = 5.0 / pieces;
    fallen += step / 6 * (ring.slope(from) + 4 * ring.slope(from + step / 2) + ring.slope(from + step));
    CHECK(ring.extension(from + step) <= ring.extension(from));
    CHECK(1 + fallen == Approx(ring.extension(from + step)).margin(1e-6));  // measured: 1e-8
  }
}

TEST_CASE("near field: a rigid motion of any size leaves nothing, and what it is added to stays") {
  const std::vector<Point> positions{{0, 0}, {1, 0}, {0, 1}, {4, 3}, {-2, 5}};
  State bent(3, 5), moved(3, 5);
  for (Eigen::Index k = 0; k < 5; ++k) {
    const auto& x = positions[std::size_t(k)];
    bent.col(k) << x.x() * x.y(), x.x(), -x.y();
    moved.col(k) << 1e6 + 3e5 * x.x() - 2e5 * x.y(), -2e5, -3e5;  // w = c - theta_y x + theta_x y
  }
  const State both = bent + moved;
  const NearField none(moved, positions, {0, 1, 2}), plain(bent, positions, {0, 1, 2}), sum(both, positions, {0, 1, 2});
  for (std::uint32_t k = 0; k < 5; ++k) {
    CHECK(std::abs(none(k).w) < 1e-8);  // measured: 5e-10, of 1e6
    CHECK(std::abs(none(k).theta_x) + std::abs(none(k).theta_y) < 1e-9);
    CHECK(sum(k).w == Approx(plain(k).w).margin(1e-8));
    CHECK(sum(k).theta_y == Approx(plain(k).theta_y).margin(1e-9));
  }
}
