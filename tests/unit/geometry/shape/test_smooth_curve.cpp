#include "geometry/shape/smooth_curve.hpp"

#include <numbers>
#include <random>

#include "tests/catch.hpp"

using namespace geometry;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// An arc about the origin by so many pieces, its middle up.
Polyline arc_of(double radius, double degrees, int pieces) {
  Polyline result;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = std::numbers::pi / 2 + degrees * degree * (double(i) / pieces - 0.5);
    result.push_back(radius * Point(std::cos(angle), std::sin(angle)));
  }
  return result;
}

double farthest_from_circle(const Polyline& line, double radius) {
  double result = 0;
  for (const Point& x : line) result = std::max(result, std::abs(x.norm() - radius));
  return result;
}

}  // namespace

TEST_CASE("pieces of an arc with slight bends are taken as the arc, with tangent ends") {
  for (const double degrees : {60.0, 120.0, 180.0, 300.0})
    for (const int pieces : {24, 96}) {
      if (degrees / pieces > 10) continue;
      const std::vector<Polyline> cracks{arc_of(2, degrees, pieces)};
      CAPTURE(degrees, pieces);
      const auto found = smooth_crack(cracks, 0, 1e-9);
      REQUIRE(found);
      CHECK(found->pieces == std::size_t(pieces));
      CHECK(found->largest_bend == Approx(degrees / pieces * degree));
      CHECK(found->vertices.front() == cracks[0].front());
      CHECK(farthest_from_circle(found->vertices, 2) < 1e-5);
      CHECK_FALSE(smooth_crack({found->vertices}, 0, 1e-9));  // it is fine already
      for (const double size : {0.1, 0.02, 1e-3}) {
        const auto line = drawn({found->vertices}, 0, 1e-9, [&](const Point& x) {
          return size + 0.2 * std::min((x - cracks[0].front()).norm(), (x - cracks[0].back()).norm());
        });
        CHECK(line.back() == cracks[0].back());
        CHECK((line[1] - line[0]).norm() < 1.3 * size);
        for (const bool at_back : {false, true}) {
          const auto circle = tip_circle({line, End::tip, End::tip}, at_back, size);
          REQUIRE(circle);
          const double angle = (90 + (at_back ? 0.5 : -0.5) * degrees) * degree;
          const Point tangent = (at_back ? 1 : -1) * Point(-std::sin(angle), std::cos(angle));
          CHECK((circle->direction - tangent).norm() < 1e-3);
          CHECK(circle->curvature == Approx(at_back ? 0.5 : -0.5).epsilon(0.01));
        }
      }
    }
}

TEST_CASE("kinks, short polylines, zigzags and lines that grow in legs are no curves") {
  const auto smooth = [](const Polyline& line) { return bool(smooth_crack({line}, 0, 1e-9)); };
  CHECK_FALSE(smooth({{0, 0}, {1, 0}, {2, 0.1}, {3, 0.3}, {4, 0.6}}));  // three bends
  CHECK_FALSE(smooth(arc_of(1, 180, 16)));                              // 11.25 degrees
  CHECK(smooth(arc_of(1, 180, 18)));
  Polyline zigzag;
  for (int i = 0; i < 20; ++i) zigzag.emplace_back(i, i % 2 ? 0.05 : 0.0);
  CHECK_FALSE(smooth(zigzag));
  const CrackPath legs{{{0, 0}, {5, 0}, {10, 0.4}, {15, 1.2}}, End::mouth, End::tip};
  CHECK_FALSE(tip_circle(legs, true, 1));
  CHECK_FALSE(tip_circle({{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, End::mouth, End::tip}, true, 1));  // straight
}

TEST_CASE("corners and junctions of curves stay where they are") {
  auto line = arc_of(1, 90, 18);
  const Point corner = line.back();
  line.push_back(corner + Point(0.05, 0.2)), line.push_back(corner + Point(0.1, 0.5));
  const Point on_it = (line[8] + line[9]) / 2;
  const std::vector<Polyline> cracks{line, {on_it, on_it + Point(0, 1)}};
  const auto found = smooth_crack(cracks, 0, 1e-9);
  REQUIRE(found);
  const auto has = [](const Polyline& of, const Point& x) { return std::ranges::find(of, x) != of.end(); };
  CHECK(has(found->vertices, corner));
  CHECK(has(found->vertices, on_it));
  const auto coarse = drawn({found->vertices, cracks[1]}, 0, 1e-9, [](const Point&) { return 0.15; });
  CHECK(has(coarse, corner));
  CHECK(has(coarse, on_it));
  CHECK(coarse.back() == line.back());
  CHECK(coarse.size() < 25);
}

TEST_CASE("points with an error are taken as the curve of the fewest spans within the tolerance") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> error(-0.5, 0.5);  // of a pixel
  for (const double degrees : {30.0, 90.0, 150.0}) {
    Polyline traced = arc_of(400, degrees, 500);
    for (std::size_t i = 1; i + 1 < traced.size(); ++i) traced[i] += Point(error(random), error(random));
    const auto found = fitted_curve(traced, 2);
    CAPTURE(degrees, found.spans, found.off);
    CHECK(found.spans <= 6);  // measured: 1 to 3
    CHECK(found.off <= 2);
    const auto line = curve_through(found.points);
    CHECK(farthest_from_circle(line, 400) < 0.8);  // measured: 0.1 to 0.44
    const Point end = (line.back() - line[line.size() - 2]).normalized();
    const double angle = (90 + degrees / 2) * degree;
    CHECK(std::abs(end.x() * -std::sin(angle) + end.y() * std::cos(angle) - 1) < 1e-4);  // within 0.8 degrees
  }
}
