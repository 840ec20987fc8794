#include "plate/model/load_integration.hpp"

#include <cmath>

#include "tests/catch.hpp"

using geometry::Point;

namespace {

const std::vector<Point> moved_square{{1, 2}, {3, 2}, {3, 4}, {1, 4}};

}  // namespace

TEST_CASE("cubature: polynomials of the second order to rounding, moments about the place that is given") {
  int calls = 0;
  plate::Cubature cubature([&](const Point& x) {
    ++calls;
    return x.x() * x.y() - 20;
  });
  const auto found = cubature(moved_square, {2, 3});
  CHECK(found.value == Approx(6 * 4 - 80).epsilon(1e-14));
  CHECK(found.size == Approx(80 - 6 * 4).epsilon(1e-14));
  CHECK(found.first.x() == Approx(4).epsilon(1e-13));  // int x y (x - 2) = int x (x - 2) int y = 2 / 3 * 6
  CHECK(found.error == 0);
  CHECK(calls == 4 * 15);
}

TEST_CASE("cubature: refined where the function asks for it, what is left is told") {
  plate::Cubature smooth([](const Point& x) { return std::exp(3 * x.x()); });
  const double expected = (std::exp(9.0) - std::exp(3.0)) / 3 * 2;
  const auto found = smooth(moved_square, {2, 3});
  CHECK(found.value == Approx(expected).epsilon(1e-4));
  CHECK(found.error == 0);
  plate::Cubature jump([](const Point& x) { return x.x() + 0.3 * x.y() < 2.71 ? 5.0 : 0.0; });
  const double below = 5 * 2 * (2.71 - 0.9 - 1);  // mean width of the part
  const auto cut = jump(moved_square, {2, 3});
  CHECK(std::abs(cut.value - below) < 0.015 * below);  // measured: 0.0096
  CHECK(cut.error > 0);
  CHECK(cut.error > std::abs(cut.value - below) / 10);
}

TEST_CASE("cubature: a polygon has the same integral whatever was integrated before it") {
  const auto f = [](const Point& x) { return x.x() + 0.3 * x.y() < 2.71 ? 5.0 : 1e3 * x.y(); };
  plate::Cubature alone(f), after(f);
  after({{0, 1e3}, {1, 1e3}, {1, 2e3}, {0, 2e3}}, {0, 0});  // of values a thousand times as large
  const auto one = alone(moved_square, {2, 3}), other = after(moved_square, {2, 3});
  CHECK(one.value == other.value);
  CHECK(one.error == other.error);
}
