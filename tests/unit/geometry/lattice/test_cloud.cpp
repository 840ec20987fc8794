#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"

using namespace geometry;

TEST_CASE("lattice units: decimals that differ by rounding are one number, there and back within it") {
  const LatticeUnits units{{0.1, -0.3}, 0.1};
  CHECK(units.to_lattice({0.1 + 0.2, 0}) == units.to_lattice({0.3, 0}));
  CHECK(units.to_lattice({0.3, 0.1}) == Point(2, 4));
  for (const Point& x : {Point(0.7, 0.2), Point(-3.21, 1e3), Point(0.123456789, 0)})
    CHECK((units.from_lattice(units.to_lattice(x)) - x).cwiseAbs().maxCoeff() <=
          0.1 / (1 << 20));  // half a step of 2^-20 each
}

TEST_CASE("lattice units: outlines and cracks keep names and kinds, circles their shape") {
  auto outline = rectangle(0, 0, 2, 1);
  outline.holes = {Circle{{0.5, 0.5}, 0.25, "round"}, Polygon{{{1, 0.2}, {1.2, 0.2}, {1.1, 0.4}}, {"a", "b", "c"}}};
  const auto scaled = to_lattice(outline, {{-1, 0}, 0.5});
  CHECK(scaled.outer.vertices[2] == Point(6, 2));
  CHECK(edge_names(scaled) == edge_names(outline));
  const auto& circle = std::get<Circle>(scaled.holes[0]);
  CHECK(circle.centre == Point(3, 1));
  CHECK(circle.radius == 0.5);
  const auto paths = to_lattice(std::vector<CrackPath>{{{{0, 0.5}, {0.5, 0.5}}, End::mouth, End::tip}}, {{-1, 0}, 0.5});
  CHECK(paths[0].vertices[1] == Point(3, 1));
  CHECK(paths[0].front == End::mouth);
  CHECK(paths[0].back == End::tip);
}

TEST_CASE("nearest plate point: of the plate alone, the first of those that are as near") {
  const Cloud cloud{{}, {{0, 0}, {1, 0}, {2, 0}, {1.6, 0}}, {1, 1, 1, 1}, 3};
  CHECK(nearest_plate_point(cloud, {1.6, 0}) == 2);
  CHECK(nearest_plate_point(cloud, {0.5, 7}) == 0);
  CHECK(nearest_plate_point(cloud, {-100, 0}) == 0);
}
