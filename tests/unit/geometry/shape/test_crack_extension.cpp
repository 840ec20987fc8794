#include "geometry/shape/crack_path.hpp"

#include <cmath>

#include "tests/catch.hpp"

using namespace geometry;

namespace {

Tip tip(std::size_t crack, const Polyline& vertices, bool at_back) {
  const Point end = at_back ? vertices.back() : vertices.front();
  const Point before = at_back ? vertices[vertices.size() - 2] : vertices[1];
  return {end, (end - before).normalized(), crack, at_back};
}

}  // namespace

TEST_CASE("obstacle ahead: the first of edges, holes and cracks, its own crack too, within reach only") {
  auto outline = rectangle(-1, -1, 1, 1);
  outline.holes.push_back(Circle{{0.5, 0.1}, 0.2, "hole0"});
  const std::vector<Polyline> cracks{
      {{-0.5, 0}, {-0.2, 0}}, {{-0.4, -0.6}, {-0.4, -0.2}}, {{-0.6, 0.2}, {-0.6, 0.5}, {-0.3, 0.5}}};
  const Tip right = tip(0, cracks[0], true), left = tip(0, cracks[0], false);

  const auto hole = obstacle_ahead(outline, cracks, right, right.direction, 2);
  REQUIRE(hole);
  CHECK(hole->name == "hole0");
  CHECK(hole->distance == Approx(0.7 - std::sqrt(0.04 - 0.01)));
  CHECK((hole->position - Point(0.5, 0.1)).norm() == Approx(0.2));
  CHECK_FALSE(obstacle_ahead(outline, cracks, right, right.direction, 0.5));

  const auto edge = obstacle_ahead(outline, cracks, left, left.direction, 2);
  REQUIRE(edge);
  CHECK(edge->name == "left");
  CHECK(edge->distance == Approx(0.5));

  const auto crack = obstacle_ahead(outline, cracks, tip(1, cracks[1], true), Point(0, 1), 2);
  REQUIRE(crack);
  CHECK(crack->crack == 0u);
  CHECK(crack->name.empty());
  CHECK(crack->distance == Approx(0.2));

  const std::vector<Polyline> facing{{{-0.5, -0.8}, {0, -0.8}}, {{0.3, -0.8}, {0.6, -0.8}}};
  const auto other = obstacle_ahead(outline, facing, tip(0, facing[0], true), Point(1, 0), 1);
  REQUIRE(other);  // along the way itself
  CHECK(other->crack == 1u);
  CHECK(other->distance == Approx(0.3));

  const Tip turned = tip(2, cracks[2], true);  // back to its own beginning
  const auto own = obstacle_ahead(outline, cracks, turned, Point(-0.3, -0.2).normalized(), 1);
  REQUIRE(own);
  CHECK(own->crack == 2u);
  CHECK((own->position - Point(-0.6, 0.3)).norm() < 1e-12);
}

TEST_CASE("nearest obstacle: ahead or beside, within reach, other cracks only") {
  auto outline = rectangle(-1, -1, 1, 1);
  outline.holes.push_back(Circle{{0.5, 0.5}, 0.2, "hole0"});
  const std::vector<Polyline> cracks{{{-0.5, 0}, {0.2, 0}}, {{0.3, -0.6}, {0.3, -0.05}}};
  const auto crack = nearest_obstacle(outline, cracks, tip(0, cracks[0], true), 0.2);
  REQUIRE(crack);
  CHECK(crack->crack == 1u);
  CHECK(crack->distance == Approx(std::hypot(0.1, 0.05)));
  CHECK_FALSE(nearest_obstacle(outline, cracks, tip(0, cracks[0], true), 0.1));
  const auto hole = nearest_obstacle(outline, {{{0.4, 0.1}, {0.5, 0.2}}}, tip(0, {{0.4, 0.1}, {0.5, 0.2}}, true), 1);
  REQUIRE(hole);
  CHECK(hole->name == "hole0");
  CHECK(hole->distance == Approx(0.1));
  // another crack that ends on this one, behind its tip; its part ahead is farther
  const std::vector<Polyline> met{{{-0.5, 0}, {0.2, 0}}, {{0, -0.5}, {0, 0}}, {{-0.1, 0.1}, {0.8, 0.1}}};
  const auto beside = nearest_obstacle(outline, met, tip(0, met[0], true), 1);
  REQUIRE(beside);
  CHECK(beside->crack == 2u);
  CHECK((beside->position - Point(0.2, 0.1)).norm() < 1e-12);
  CHECK_FALSE(nearest_obstacle(outline, {met[0], met[1]}, tip(0, met[0], true), 0.3));
}

TEST_CASE("extend: straight on the last vertex moves, else it becomes a bend, at either end") {
  Polyline crack{{0, 0}, {1, 0}};
  extend(crack, true, {1.5, 0});
  CHECK(crack == Polyline{{0, 0}, {1.5, 0}});
  extend(crack, true, {2, 0.5});
  CHECK(crack == Polyline{{0, 0}, {1.5, 0}, {2, 0.5}});
  extend(crack, false, {-1, 0});
  extend(crack, false, {-1, -1});
  CHECK(crack == Polyline{{-1, -1}, {-1, 0}, {1.5, 0}, {2, 0.5}});
  CHECK(length(crack) == Approx(3.5 + std::sqrt(0.5)));
}
