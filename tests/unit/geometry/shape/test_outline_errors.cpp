#include "geometry/shape/outline.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

/// The square [0, 10]^2 with the hole [4, 6] x [4, 6], given counter-clockwise.
Outline square_with_square_hole() {
  Outline plate = rectangle(0, 0, 10, 10);
  plate.holes.push_back(Polygon{{{4, 4}, {6, 4}, {6, 6}, {4, 6}}, {"s", "e", "n", "w"}});
  return plate;
}

Outline ell_shape() {
  return {{{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {}}, {}};
}

std::string only_error(const Outline& plate) {
  const auto found = errors(plate);
  REQUIRE(found.size() == 1);
  return found[0].where + ": " + found[0].what;
}

}  // namespace

TEST_CASE("faults of outlines say what is wrong and where") {
  using Catch::Contains;
  const auto outer = [](std::vector<Point> vertices) { return only_error({{std::move(vertices), {}}, {}}); };
  CHECK(errors(square_with_square_hole()).empty());
  CHECK(errors(ell_shape()).empty());
  CHECK_THAT(outer({{0, 0}, {1, 0}}), Contains("outline: has 2 vertices"));
  CHECK_THAT(outer({{0, 0}, {1, 0}, {1, 1}, {1, 0}}), Contains("vertices 1 and 3 are both at (1, 0)"));
  CHECK_THAT(outer({{0, 0}, {1, 0}, {2, 0}}), Contains("no area"));
  CHECK_THAT(outer({{0, 0}, {0, 1}, {1, 1}}), Contains("clockwise"));
  CHECK_THAT(outer({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), Contains("edges 0 (from (0, 0) to (1, 1)) and 2"));
  const auto spike = errors(Outline{{{{0, 0}, {2, 0}, {1, 0}, {1, 1}}, {}}, {}});
  REQUIRE(spike.size() == 2);  // the tip of the spike also lies on edge 0
  CHECK_THAT(spike[0].what, Contains("edges 0 and 1 fold back"));
  const auto with = [](std::vector<Hole> holes) {
    Outline plate = rectangle(-1, -1, 1, 1);
    plate.holes = std::move(holes);
    return only_error(plate);
  };
  CHECK_THAT(with({Circle{{0, 0}, -0.1, ""}}), Contains("holes[0]: radius -0.1 must be positive"));
  CHECK_THAT(with({Circle{{0.9, 0}, 0.5, ""}}),
             Contains("holes[0]: circle of radius 0.5 about (0.9, 0) reaches 0.4 beyond the outline"));
  CHECK_THAT(with({Circle{{3, 0}, 0.5, ""}}), Contains("has its centre 2 outside the outline"));
  CHECK_THAT(with({Circle{{0, 0}, 0.5, ""}, Circle{{0.5, 0}, 0.25, ""}}), Contains("holes[1]: overlaps holes[0]"));
  CHECK_THAT(with({Circle{{0, 0}, 0.5, ""}, Polygon{{{-0.1, 0}, {0.1, 0}, {0, 0.1}}, {}}}),
             Contains("overlaps holes[0]"));
  const Polygon big{{{-0.5, -0.5}, {0.5, -0.5}, {0, 0.5}}, {}}, small{{{-0.1, -0.1}, {0.1, -0.1}, {0, 0.1}}, {}};
  CHECK_THAT(with({big, small}), Contains("holes[1]: overlaps holes[0]"));
  CHECK_THAT(with({Polygon{{{0, 0}, {1.5, 0}, {0, 0.5}}, {}}}), Contains("vertex 1 at (1.5, 0) lies 0.5 outside"));
  CHECK_THAT(with({Polygon{{{0, 0}, {1, 0}}, {}}}), Contains("holes[0]: has 2 vertices"));
}
