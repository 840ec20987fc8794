#include "plate/formulation/interpolation.hpp"

#include <array>
#include <functional>
#include <random>

#include "tests/catch.hpp"

using geometry::Point;
using plate::interpolation;

namespace {

using Points = std::vector<std::pair<std::uint32_t, Point>>;

double value(const std::vector<plate::Share>& shares, const Points& points,
             const std::function<double(const Point&)>& f) {
  double sum = 0;
  for (const auto& share : shares)
    for (const auto& [id, x] : points)
      if (id == share.point) sum += share.weight * f(x);
  return sum;
}

}  // namespace

TEST_CASE("interpolation: exact for linear fields on scattered points") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (int trial = 0; trial < 100; ++trial) {
    Points points;
    for (std::uint32_t i = 0; i < 3 + unsigned(trial) % 9; ++i)
      points.emplace_back(10 + i, Point(uniform(random), uniform(random)));
    // three points next to a line make large weights
    const Point a = points[1].second - points[0].second, b = points[2].second - points[0].second;
    if (points.size() == 3 && std::abs(a.x() * b.y() - a.y() * b.x()) < 0.1)
      points.emplace_back(99, Point(2, -2)), points.emplace_back(98, Point(-2, 1));
    const Point at(uniform(random), uniform(random));
    const auto shares = interpolation(points, at);
    REQUIRE(shares.size() == points.size());
    CHECK(value(shares, points, [](const Point&) { return 1.0; }) == Approx(1).epsilon(1e-11));  // measured: 3e-15
    const auto linear = [](const Point& x) { return 3 + 2 * x.x() - x.y(); };
    CHECK(value(shares, points, linear) == Approx(linear(at)).margin(1e-10));  // measured: 1e-14
  }
}

TEST_CASE("interpolation: at a point, its own value") {
  const Points points{{4, {0, 0}}, {7, {1, 0}}, {9, {0, 1}}};
  const auto shares = interpolation(points, {1, 0});
  REQUIRE(shares.size() == 1);
  CHECK(shares[0].point == 7);
  CHECK(shares[0].weight == 1);
}

TEST_CASE("interpolation: close to a point, close to its value") {
  const Points points{{4, {0, 0}}, {7, {1, 0}}, {9, {0, 1}}, {11, {1, 1}}};
  const auto shares = interpolation(points, {1 - 1e-4, 1e-4});
  const auto bump = [](const Point& x) { return x.x() * x.y() == 0 && x.x() == 1 ? 1.0 : 0.0; };
  CHECK(value(shares, points, bump) == Approx(1).margin(1e-3));  // measured: 1e-4
}

TEST_CASE("interpolation: in the middle of four points, a quarter of each") {
  const Points points{{0, {0, 0}}, {1, {1, 0}}, {2, {0, 1}}, {3, {1, 1}}};
  for (const auto& share : interpolation(points, {0.5, 0.5})) CHECK(share.weight == Approx(0.25).epsilon(1e-14));
}

TEST_CASE("interpolation: points on one line, one point, none") {
  const Points line{{0, {0, 0}}, {1, {1, 0}}, {2, {2, 0}}};
  const auto shares = interpolation(line, {0.5, 0});
  const double found = value(shares, line, [](const Point& x) { return 1 + 3 * x.x(); });
  CHECK(found == Approx(2.5).epsilon(1e-12));  // measured: 2e-16
  const auto one = interpolation({{3, {1, 0}}}, {1, 0});
  REQUIRE(one.size() == 1);
  CHECK(one[0].weight == 1);
  CHECK(interpolation({}, {0, 0}).empty());
}

TEST_CASE("place shares: of points on one line, of one point and of none") {
  const Points line{{0, {0, 0}}, {1, {1, 0}}, {2, {2, 0}}}, one{{3, {1, 2}}},
      bent{{0, {0, 0}}, {1, {1, 0}}, {2, {2, 0.1}}};
  constexpr double spacing = 0.5;
  for (const auto& points : {line, one, bent})
    for (const Point& at : {Point(0.5, 0.8), Point(-1, 0), Point(1, 0)}) {
      plate::State u = plate::State::Zero(3, 4);  // w = 2 + 3 x - y
      for (const auto& [k, x] : points) u.col(k) << 2 + spacing * (3 * x.x() - x.y()), -1, -3;
      const Eigen::Vector3d expected(2 + spacing * (3 * at.x() - at.y()), -1, -3);
      const auto place = plate::place_shares(points, at, spacing);
      CHECK((plate::value_at(place, u) - expected).norm() < 1e-12);  // measured: 1e-15
      for (std::uint32_t component = 0; component < 3; ++component) {
        double sum = 0;
        for (const auto& [dof, factor] : plate::terms_of(place, component)) sum += factor * plate::at_dof(u, dof);
        CHECK(sum == Approx(expected[component]).epsilon(1e-12));
      }
    }
  CHECK_THROWS_AS(plate::place_shares({}, {0, 0}, spacing), std::invalid_argument);
}

TEST_CASE("place shares: where points span the plane, those of the interpolation") {
  const Points points{{0, {0, 0}}, {1, {1, 0}}, {2, {0, 1}}, {3, {1, 1}}};
  const auto expected = interpolation(points, {0.3, 0.2});
  const auto place = plate::place_shares(points, {0.3, 0.2}, 0.1);
  REQUIRE(place.size() == expected.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    CHECK(place[i].weight == expected[i].weight);
    CHECK(place[i].lever == Point(0, 0));
  }
}

TEST_CASE("interpolation: of the points that a place sees, those near it and on its side of a crack") {
  const std::vector<Point> lattice{{0.5, 0.5}, {1.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {2.5, 1.5}, {1.5, 1.2}};
  const std::vector<geometry::CrackPath> crack{{{{0, 1}, {3, 1}}, geometry::End::tip, geometry::End::tip}};
  const auto above = plate::visible_from({1.2, 1.1}, 1.2, lattice, 5, crack);  // the last one does not count
  REQUIRE(above.size() == 2);
  CHECK(above[0].first == 2);
  CHECK(above[1].second == Point(1.5, 1.5));
  CHECK(plate::visible_from({1.2, 0.9}, 1.2, lattice, 5, crack).front().first == 0);
  CHECK(plate::visible_from({1.2, 0.9}, 1.2, lattice, 5, {}).size() == 4);
}

TEST_CASE("level transfer: transposed, every share stands at the other point, in ascending order") {
  const plate::LevelTransfer<double> finer{{0, 2, 2, 3}, {{1, 0.25, 1, 2}, {0, 0.75, 3, 4}, {1, 1, 5, 6}}};
  const auto coarser = finer.transposed(3);
  CHECK(coarser.first == std::vector<std::size_t>{0, 1, 3, 3});
  const std::array expected{std::array{0.0, 0.75, 3.0, 4.0}, std::array{0.0, 0.25, 1.0, 2.0},
                            std::array{2.0, 1.0, 5.0, 6.0}};
  REQUIRE(coarser.shares.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& share = coarser.shares[i];
    CHECK(std::array{double(share.other), share.weight, share.x, share.y} == expected[i]);
  }
}
