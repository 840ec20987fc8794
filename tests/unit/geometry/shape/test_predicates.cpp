#include "geometry/shape/predicates.hpp"

#include <random>

#include "tests/catch.hpp"

using namespace geometry;

TEST_CASE("predicates: sides of points that decimals put a rounding beside a line are those of the numbers") {
  // 53 bits: with whole numbers below 2^26 the products are exact
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> whole(-(1 << 24), 1 << 24);
  int on = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::array<std::int64_t, 2> a{whole(random), whole(random)}, d{whole(random) >> 12, whole(random) >> 12};
    const std::int64_t t = whole(random) >> 18, e = i % 3 - 1;  // a point of the line, moved by -1, 0, 1
    const std::array<std::int64_t, 2> b{a[0] + d[0], a[1] + d[1]}, c{a[0] + t * d[0], a[1] + t * d[1] + e};
    const std::int64_t exact = d[0] * e;
    const auto point = [](const auto& x) { return Point(double(x[0]), double(x[1])); };
    CHECK(side(point(a), point(b), point(c)) == (exact > 0) - (exact < 0));
    on += exact == 0;
  }
  CHECK(on > 500);
  CHECK(side({0.1, 0.1}, {0.3, 0.3}, {0.2, 0.2}) == 0);
  CHECK(side({0, 0}, {1e-300, 1e-300}, {1e300, 1.0000000000000002e300}) == 1);
}

TEST_CASE("predicates: inside, on and outside a ring, whichever way it runs and however its corners lie to the point") {
  Ring ring{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}};  // a notch from above
  for (int turn = 0; turn < 2; ++turn) {
    CHECK(position(ring, {1, 2}) == 1);  // level with the notch's corner
    CHECK(position(ring, {2, 3}) == -1);
    CHECK(position(ring, {-1, 2}) == -1);
    CHECK(position(ring, {-1, 0}) == -1);  // in line with an edge
    CHECK(position(ring, {5, 0}) == -1);
    for (const Point& corner : ring) CHECK(position(ring, corner) == 0);
    CHECK(position(ring, {3, 3}) == 0);
    CHECK(position(ring, {2, 0}) == 0);
    std::ranges::reverse(ring);
  }
  CHECK(position({}, {0, 0}) == -1);
}

TEST_CASE("predicates: areas and distances of rings and segments, those without length too") {
  const Ring ring{{1e6, 1e6}, {1e6 + 3, 1e6}, {1e6 + 3, 1e6 + 2}};
  CHECK(signed_area(ring) == 3);
  CHECK(signed_area({ring.rbegin(), ring.rend()}) == -3);
  CHECK(distance_to_segment({0, 0}, {4, 0}, {2, 3}) == 3);
  CHECK(distance_to_segment({0, 0}, {4, 0}, {7, 4}) == 5);
  CHECK(distance_to_segment({1, 1}, {1, 1}, {4, 5}) == 5);
  CHECK(nearest_on_segment({0, 0}, {4, 0}, {2, 3}) == Point(2, 0));
  CHECK(nearest_on_segment({0, 0}, {4, 0}, {7, 4}) == Point(4, 0));
  CHECK(nearest_on_segment({1, 1}, {1, 1}, {4, 5}) == Point(1, 1));
  CHECK(boxes_meet({0, 0}, {1, 1}, {1, 1}, {2, 2}));
  CHECK(boxes_meet({1, 1}, {0, 0}, {2, 0.5}, {-1, 0.5}));
  CHECK_FALSE(boxes_meet({0, 0}, {1, 1}, {1.1, 0}, {2, 1}));
}
