#include "plate/edges/outlines.hpp"
#include "tests/catch.hpp"

using geometry::Point;

TEST_CASE("oblique clearance: width, gaps and steps of turned outlines, holes among them") {
  const double c = 0.6, s = 0.8;
  const auto turned = [&](const std::vector<Point>& corners) {
    geometry::Outline result;
    for (const auto& x : corners) result.outer.vertices.push_back({c * x.x() - s * x.y(), s * x.x() + c * x.y()});
    return result;
  };
  const auto square = plate::oblique_clearance(turned({{0, 0}, {12, 0}, {12, 9}, {0, 9}}), 1);
  CHECK(square.width.value == Approx(9));
  CHECK(square.gap.value == std::numeric_limits<double>::infinity());
  CHECK(square.step.value == Approx(9));
  const auto notched = turned({{0, 0}, {12, 0}, {12, 9}, {8, 9}, {8, 3}, {5, 3}, {5, 9}, {0, 9}});
  CHECK(plate::oblique_clearance(notched, 0.5).gap.value == Approx(3));
  CHECK(plate::oblique_clearance(notched, 0.5).width.value == Approx(3));
  auto holed = geometry::rectangle(0, 0, 20, 20);
  holed.holes = {geometry::Circle{{10, 12}, 2, "round"}};
  const auto round = plate::oblique_clearance(holed, 1);
  CHECK(round.gap.value == Approx(4).epsilon(1e-6));
  CHECK(round.width.value == Approx(6).epsilon(0.05));  // measured: the middles of parts nearest to the top miss it
}

TEST_CASE("oblique clearance: blunt corners are no steps, sharp ones do not make a plate narrow") {
  geometry::Outline round;
  for (int i = 0; i < 24; ++i) {
    const double angle = i * 3.141592653589793 / 12;
    round.outer.vertices.push_back(5 * Point(std::cos(angle), std::sin(angle)));
  }
  const auto c = plate::oblique_clearance(round, 1);
  CHECK(c.step.value == std::numeric_limits<double>::infinity());
  CHECK(c.width.value > 9);
  CHECK(plate::shortest_edge(round).value == Approx(10 * std::sin(3.141592653589793 / 24)));
  const geometry::Outline triangle{{{{0, 0}, {10, 1}, {1, 9}}, {}}, {}};
  CHECK(plate::oblique_clearance(triangle, 1).width.value == std::numeric_limits<double>::infinity());
}
