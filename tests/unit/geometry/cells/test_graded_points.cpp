#include "tests/unit/geometry/cells/checked_cells.hpp"

using namespace checked_cells;

TEST_CASE("points may be a million times closer together at tips, at any angle") {
  for (const double ratio : {1e2, 1e3, 1e4, 1e5, 1e6})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const double at_tips = 2 / ratio;
      const auto cells = inclined(degrees, at_tips, 0.4);
      CAPTURE(ratio, degrees);
      const auto found = measures(cells);
      CHECK(found.area == Approx(4).epsilon(1e-12));
      CHECK(found.least_angle > 15);  // measured: 18
      CHECK(crack_length(cells) == Approx(0.6).epsilon(1e-12));
      CHECK(cells.positions.size() < 1500);  // measured: 950
    }
}

TEST_CASE("about a tip the triangles are nearly equal") {
  for (const double at_tips : {0.02, 1e-4})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const auto cells = inclined(degrees, at_tips, 0.2);
      const double angle = degrees * std::numbers::pi / 180;
      const Point tip(0.3 * std::cos(angle), 0.3 * std::sin(angle));
      std::size_t fan = 0;
      double least = 180, largest = 0, shortest = 1, longest = 0;
      for (const auto& triangle : cells.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          if ((cells.positions[triangle[i]] - tip).norm() > 1e-3 * at_tips) continue;
          const Point a = cells.positions[triangle[(i + 1) % 3]] - tip,
                      b = cells.positions[triangle[(i + 2) % 3]] - tip;
          const double turn = std::atan2(cross(a, b), a.dot(b)) * 180 / std::numbers::pi;
          least = std::min(least, turn), largest = std::max(largest, turn), ++fan;
          shortest = std::min(shortest, a.norm()), longest = std::max(longest, a.norm());
        }
      CAPTURE(at_tips, degrees, fan, least, largest, shortest / at_tips, longest / at_tips);
      CHECK(fan >= 5);
      CHECK(fan <= 8);
      CHECK(least > 35);
      CHECK(largest < 80);
      CHECK(shortest > 0.8 * at_tips);
      CHECK(longest < 1.4 * at_tips);
    }
}

TEST_CASE("a force next to a tip has equal triangles about it, as small as growth^2 of the way there") {
  const auto plate = rectangle(-1, -1, 1, 1);
  const auto paths = crack_paths(plate, {Polyline{Point(-0.3, 0), Point(0.3, 0)}}, 1e-9);
  for (const double away : {0.03, 0.1, 0.4})
    for (int degrees = 0; degrees <= 150; degrees += 30) {
      const double angle = degrees * std::numbers::pi / 180, at_tips = 1e-4, growth = 0.2;
      const Point place = Point(0.3, 0) + away * Point(std::cos(angle), std::sin(angle));
      const auto cells = tessellation(plate, paths, 0.2, {place}, {at_tips, {}, growth, {place}});
      const double wanted = growth * growth * away;
      std::size_t fan = 0;
      double shortest = 1, longest = 0;
      for (const auto& triangle : cells.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
          if ((cells.positions[triangle[i]] - place).norm() > 1e-9) continue;
          for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
            const double side = (cells.positions[triangle[j]] - place).norm();
            shortest = std::min(shortest, side), longest = std::max(longest, side);
          }
          ++fan;
        }
      CAPTURE(away, degrees, fan, shortest / wanted, longest / wanted);
      CHECK(fan >= 5);
      CHECK(fan <= 8);
      CHECK(shortest > 0.7 * wanted);  // measured 0.73
      CHECK(longest < 1.4 * wanted);
      CHECK(measures(cells).least_angle > 15);
      const auto without = tessellation(plate, paths, 0.2, {place}, {at_tips, {}, growth});
      CHECK(cells.positions.size() < 1.5 * double(without.positions.size()));
    }
}
