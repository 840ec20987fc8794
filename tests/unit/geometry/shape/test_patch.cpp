#include "geometry/shape/patch.hpp"

#include <numbers>
#include <random>

#include "tests/catch.hpp"

using namespace geometry;
using Ring = std::vector<Point>;

namespace {

const Polygon angle{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};  // L

Ring square(const Point& low, double side) {
  return {low, low + Point(side, 0), low + Point(side, side), low + Point(0, side)};
}

AreaMoments over_cells(const Patch& patch, double side, const Point& about) {
  AreaMoments sum;
  for (int i = -4; i * side < 5; ++i)
    for (int j = -4; j * side < 5; ++j) {
      const auto one = moments(patch.common(square({i * side - 0.013, j * side + 0.007}, side)), about);
      sum.area += one.area, sum.first += one.first, sum.second += one.second;
    }
  return sum;
}

}  // namespace

TEST_CASE("moments of areas: a rectangle about its corner, any polygon about any place") {
  const auto m = moments({{0, 0}, {2, 0}, {2, 3}, {0, 3}}, {0, 0});
  CHECK(m.area == Approx(6));
  CHECK((m.first - Point(6, 9)).norm() < 1e-14);
  CHECK((m.second - Eigen::Matrix2d{{8, 9}, {9, 18}}).norm() < 1e-13);

  const Point about(17, -5);
  const auto own = moments(angle.vertices, {0, 0}), there = moments(angle.vertices, about);
  CHECK(there.area == Approx(own.area));
  CHECK((there.first - (own.first - own.area * about)).norm() < 1e-12);
  const Eigen::Matrix2d moved =
      own.second - own.first * about.transpose() - about * own.first.transpose() + own.area * about * about.transpose();
  CHECK((there.second - moved).norm() < 1e-10);
}

TEST_CASE("patches: what lies in the cells of a lattice is the whole, of a concave polygon either way round too") {
  for (const bool turned : {false, true}) {
    Polygon shape = angle;
    if (turned) std::reverse(shape.vertices.begin(), shape.vertices.end());
    const Patch patch(shape);
    const auto all = moments(angle.vertices, {0.4, 0.2}), sum = over_cells(patch, 0.31, {0.4, 0.2});
    CHECK(sum.area == Approx(4).epsilon(1e-13));
    CHECK((sum.first - all.first).norm() < 1e-12);
    CHECK((sum.second - all.second).norm() < 1e-12);
  }
}

TEST_CASE("patches: a circle has its area, and second moments to 3e-5") {
  const Circle circle{{0.7, 0.4}, 1.3, ""};
  const auto sum = over_cells(Patch(circle), 0.4, circle.centre);
  const double area = std::numbers::pi * circle.radius * circle.radius;
  CHECK(sum.area == Approx(area).epsilon(1e-12));
  CHECK(sum.first.norm() < 1e-12);
  const double second = area * circle.radius * circle.radius / 4;
  CHECK((sum.second - Eigen::Matrix2d::Identity() * second).norm() < 5e-5 * second);  // measured: 3.6e-5
}

TEST_CASE("patches: a cell inside is whole, one outside has nothing") {
  const Patch patch(angle);
  CHECK(patch.common(square({0.2, 0.2}, 0.1)) == square({0.2, 0.2}, 0.1));
  CHECK(patch.common(square({2, 1.5}, 0.1)).empty());
}

TEST_CASE("patches: does one meet a plate? Inside, about it, across it, in a hole, beside it") {
  auto plate = rectangle(0, 0, 4, 4);
  plate.holes.push_back(Circle{{2, 2}, 1, "hole"});
  const auto meets = [&](const Ring& ring) { return Patch(Polygon{ring, {}}).meets(plate); };
  CHECK(meets(square({0.1, 0.1}, 0.2)));
  CHECK(meets(square({-1, -1}, 9)));
  CHECK(meets({{-1, 0.2}, {5, 0.2}, {5, 0.3}, {-1, 0.3}}));
  CHECK(meets({{0, 0}, {4, 0}, {4, 2.4}, {0, 2.4}}));
  CHECK(meets(square({0, 0}, 4)));
  CHECK_FALSE(meets({{0, 4}, {4, 4}, {4, 6}, {0, 6}}));
  CHECK_FALSE(meets(square({1.9, 1.9}, 0.2)));
  CHECK_FALSE(meets(square({5, 5}, 1)));
}
