#include "plate/edges/outlines.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

geometry::Outline ell(double arm) {
  return {{{{0, 0}, {10, 0}, {10, arm}, {arm, arm}, {arm, 9}, {0, 9}}, {}}, {}};
}

geometry::Polygon square(const Point& low, double side) {
  return {{low, low + Point(0, side), low + Point(side, side), low + Point(side, 0)}, {}};  // clockwise
}

}  // namespace

TEST_CASE("rectilinear: edges along the axes, also those of holes") {
  auto plate = ell(4);
  CHECK(is_rectilinear(plate));
  plate.holes.push_back(square({1, 1}, 2));
  CHECK(is_rectilinear(plate));
  plate.holes.push_back(geometry::Circle{{8, 2}, 0.5, "round"});
  CHECK(!is_rectilinear(plate));
  plate.holes.pop_back();
  plate.outer.vertices[0] = {0.1, 0};
  CHECK(!is_rectilinear(plate));
}

TEST_CASE("rectilinear: clearance of arms, notches, holes and corners") {
  const auto of_ell = clearance(ell(4));
  CHECK(of_ell.width.value == 4);
  CHECK(of_ell.gap.value == std::numeric_limits<double>::infinity());
  CHECK(of_ell.step.value == 4);
  const geometry::Outline u{{{{0, 0}, {12, 0}, {12, 9}, {8, 9}, {8, 3}, {5, 3}, {5, 9}, {0, 9}}, {}}, {}};
  CHECK(clearance(u).gap.value == 3);
  CHECK(clearance(u).gap.at == Point(6.5, 6));
  CHECK(clearance(u).width.value == 3);
  auto holed = geometry::rectangle(0, 0, 20, 20);
  holed.holes = {square({5, 5}, 4), square({10, 11}, 4)};
  CHECK(clearance(holed).width.value == Approx(std::hypot(1, 2)));  // between their corners (9, 9) and (10, 11)
  CHECK(clearance(holed).width.at == Point(9.5, 10));
  CHECK(clearance(holed).gap.value == 4);
  const geometry::Outline parted{{{{0, 0}, {3, 0}, {10, 0}, {10, 8}, {0, 8}, {0, 1}}, {}}, {}};
  CHECK(clearance(parted).step.value == 8);  // parts of an edge in one line are no steps
}

TEST_CASE("rectilinear: points, faces and their distances, edges anywhere between two rows") {
  auto outline = ell(4);
  outline.outer.vertices[2].y() = outline.outer.vertices[3].y() = 4.3;
  const auto body = rectilinear_body(outline, 3);
  CHECK(body.real == 10 * 4 + 4 * 5);
  const auto distance = [&](int x, int y, int axis, int side) {
    return body.surface[std::size_t(body.surface_node(body.node({x, y, 0}), axis, side))].distance;
  };
  CHECK(distance(9, 2, 0, 1) == 0.5);
  CHECK(distance(3, 5, 0, 1) == 0.5);
  CHECK(distance(6, 3, 1, 1) == Approx(0.8));
  CHECK(body.surface.size() == 2 * (10 + 9));  // an L has as many faces as its bounding box
  outline.outer.vertices[2].y() = outline.outer.vertices[3].y() = 4.5;
  CHECK_THROWS_AS(rectilinear_body(outline, 3), Refused);  // through a row of points
}
