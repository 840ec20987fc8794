#include "geometry/cells/tessellation.hpp"
#include "tests/catch.hpp"

namespace {

using geometry::Grading;
using geometry::Outline;
using geometry::Polyline;

double counted(const Outline& outline, const std::vector<Polyline>& cracks, double spacing, const Grading& grading) {
  const auto paths = geometry::crack_paths(outline, cracks, 1e-9);
  return double(geometry::tessellation(outline, paths, spacing, {}, grading).positions.size());
}

double expected(const Outline& outline, const std::vector<Polyline>& cracks, double spacing, const Grading& grading) {
  const auto tips = geometry::tips(geometry::crack_paths(outline, cracks, 1e-9));
  return geometry::expected_points(outline, tips, spacing, grading);
}

}  // namespace

TEST_CASE("points of a plate are told before it is made: within a quarter") {
  const auto plain = geometry::rectangle(-1, -1, 1, 1);
  auto pierced = plain;
  pierced.holes.push_back(geometry::Circle{{0.2, 0.1}, 0.3, "hole0"});
  const std::vector<Polyline> crack{{{-0.8, -0.6}, {-0.3, -0.5}}};
  for (const auto& outline : {plain, pierced})
    for (const double spacing : {0.05, 0.1})
      for (const Grading& grading : {Grading{}, Grading{0.01, {}, 0.2}, Grading{1e-5, {}, 0.3}, Grading{{}, 0.02, 0.2},
                                     Grading{0.01, 0.02, 0.1}}) {
        INFO(spacing << " " << grading.at_tips.value_or(0) << " " << grading.at_holes.value_or(0));
        CHECK(expected(outline, crack, spacing, grading) ==
              Approx(counted(outline, crack, spacing, grading)).epsilon(0.25));
      }
}

TEST_CASE("points beside edges with a layer: fine within it, few beyond") {
  const auto plate = geometry::rectangle(-1, -1, 1, 1);
  const std::vector<Polyline> crack{{{-0.4, -0.1}, {0.3, 0.2}}};
  const auto graded = [](double beyond) {
    Grading result{0.0005, {}, 0.07};
    for (const auto* name : {"left", "right", "bottom", "top"})
      result.edges.push_back({.name = name, .spacing = 0.0035, .layer = 0.0063, .beyond = beyond});
    return result;
  };
  const auto slow = expected(plate, crack, 0.05, graded(0.07)), fast = expected(plate, crack, 0.05, graded(0.7));
  CHECK(fast < 0.5 * slow);
  CHECK(counted(plate, crack, 0.05, graded(0.7)) == Approx(fast).epsilon(0.25));
  const auto cells = geometry::tessellation(plate, geometry::crack_paths(plate, crack, 1e-9), 0.05, {}, graded(0.7));
  double longest = 0;  // of the sides on the edges
  for (const auto& border : cells.borders)
    if (border.edge >= 0)
      longest = std::max(longest, (cells.positions[border.to] - cells.positions[border.from]).norm());
  CHECK(longest < 1.3 * 0.0035);
}

TEST_CASE("points about corners that reach into the plate are as near as asked") {
  using Point = geometry::Point;
  const Outline plate{{{Point(-1, -1), Point(1, -1), Point(1, 0), Point(0, 0), Point(0, 1), Point(-1, 1)},
                       {"a", "b", "c", "d", "e", "f"}},
                      {}};
  const std::vector<Polyline> crack{{{-0.6, -0.6}, {-0.3, -0.5}}};
  Grading graded{0.005, {}, 0.14};
  const double before = counted(plate, crack, 0.1, graded);
  graded.corners = {Point(0, 0)}, graded.at_corners = 0.007;
  const double points = counted(plate, crack, 0.1, graded);
  CHECK(points > before + 100);
  CHECK(expected(plate, crack, 0.1, graded) == Approx(points).epsilon(0.25));
  const auto cells = geometry::tessellation(plate, geometry::crack_paths(plate, crack, 1e-9), 0.1, {}, graded);
  double nearest = 1;
  for (const auto& x : cells.positions)
    if (x.norm() > 1e-9) nearest = std::min(nearest, x.norm());
  CHECK(nearest < 1.3 * 0.007);
}
