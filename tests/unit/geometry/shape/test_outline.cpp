#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "geometry/shape/predicates.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

/// The square [0, 10]^2 with the hole [4, 6] x [4, 6], given counter-clockwise.
Outline plate_with_square_hole() {
  Outline plate = rectangle(0, 0, 10, 10);
  plate.holes.push_back(Polygon{{{4, 4}, {6, 4}, {6, 6}, {4, 6}}, {"s", "e", "n", "w"}});
  return plate;
}

Outline plate_with_disc(double radius) {
  Outline plate = rectangle(0, 0, 10, 10);
  plate.holes.push_back(Circle{{5, 5}, radius, "hole0"});
  return plate;
}

Outline ell() {
  return {{{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, {}}, {}};
}

double sum_of_cells(const Outline& plate, int cells) {
  double sum = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) sum += clipped_cell_area(plate, {i + 0.5, j + 0.5}, 1);
  return sum;
}

}  // namespace

TEST_CASE("rectangle: counter-clockwise from the lower left, edges named") {
  const auto edges = straight_edges(rectangle(-1, -2, 3, 4));
  REQUIRE(edges.size() == 4);
  const std::vector<std::string> names{"bottom", "right", "top", "left"};
  for (std::size_t i = 0; i < 4; ++i) CHECK(edges[i].name == names[i]);
  CHECK(edges[0].from == Point(-1, -2));
  CHECK(edges[1].from == Point(3, -2));
  CHECK(edges[2].to == Point(-1, 4));
  const auto [low, high] = bounding_box(rectangle(-1, -2, 3, 4));
  CHECK(low == Point(-1, -2));
  CHECK(high == Point(3, 4));
}

TEST_CASE("straight_edges: the plate is on the left of every edge, however a hole is given") {
  Outline plate = plate_with_square_hole();
  for (int reversed = 0; reversed < 2; ++reversed) {
    for (const Edge& edge : straight_edges(plate)) {
      const Point d = edge.to - edge.from, left(-d.y(), d.x()), middle = (edge.from + edge.to) / 2;
      CHECK(contains(plate, middle + 1e-3 * left));
      CHECK_FALSE(contains(plate, middle - 1e-3 * left));
    }
    auto& hole = std::get<Polygon>(plate.holes[0]).vertices;
    std::reverse(hole.begin(), hole.end());
  }
}

TEST_CASE("edge_names are distinct and in order, edge_length adds edges and circles of one name") {
  Outline plate = plate_with_square_hole();
  plate.holes.push_back(Circle{{2, 2}, 1, "s"});
  plate.holes.push_back(Circle{{8, 8}, 1, "round"});
  const std::vector<std::string> names{"bottom", "right", "top", "left", "s", "e", "n", "w", "round"};
  CHECK(edge_names(plate) == names);
  CHECK(edge_length(plate, "s") == Approx(2 + 2 * std::numbers::pi));
  CHECK(edge_length(plate, "left") == 10);
  CHECK(edge_length(plate, "nowhere") == 0);
  CHECK(std::ranges::distance(circles(plate)) == 2);
  CHECK((*circles(plate).begin()).name == "s");
}

TEST_CASE("contains: strictly inside, exactly") {
  const Outline plate = plate_with_square_hole();
  CHECK(contains(plate, {3.9, 5}));
  CHECK_FALSE(contains(plate, {4, 5}));
  CHECK_FALSE(contains(plate, {5, 5}));
  CHECK_FALSE(contains(plate, {6, 6}));
  CHECK_FALSE(contains(plate, {0, 5}));
  CHECK_FALSE(contains(plate, {5, 10}));
  CHECK_FALSE(contains(plate, {-1, 4}));  // level with vertices
  CHECK(contains(plate, {1, 4}));
  CHECK(contains(plate, {1, 6}));
  const double above = std::nextafter(4.0, 5.0), below = std::nextafter(4.0, 3.0);
  CHECK(contains(plate, {below, 5}));
  CHECK_FALSE(contains(plate, {above, 5}));
  const Outline disc = plate_with_disc(2.5);
  CHECK_FALSE(contains(disc, {6.5, 7}));  // 1.5, 2, 2.5: on the circle
  CHECK(contains(disc, {std::nextafter(6.5, 7.0), 7}));
  CHECK_FALSE(contains(disc, {std::nextafter(6.5, 6.0), 7}));
}

TEST_CASE("contains: the diagonal of a triangle with decimal vertices is decided as in integers") {
  const Outline triangle{{{{0, 0}, {std::ldexp(3, 30), 0}, {0, std::ldexp(7, 30)}}, {}}, {}};
  std::mt19937_64 random(5);
  std::uniform_int_distribution<long> x_draw(1, (3L << 30) - 1);
  int tested = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const long x = x_draw(random);
    for (long y = (7 * ((3L << 30) - x)) / 3 - 1; y <= (7 * ((3L << 30) - x)) / 3 + 1; ++y) {
      if (y <= 0) continue;
      const bool inside = 7 * x + 3 * y < 21 * (1L << 30);
      REQUIRE(contains(triangle, {static_cast<double>(x), static_cast<double>(y)}) == inside);
      ++tested;
    }
  }
  CHECK(tested > 5000);
}

TEST_CASE("clipped_cell_area: whole, empty, cut by a slanted edge, by a re-entrant corner, by an arc") {
  const Outline square = rectangle(0, 0, 10, 10);
  CHECK(clipped_cell_area(square, {5.5, 5.5}, 1) == 1);
  CHECK(clipped_cell_area(square, {0.5, 9.5}, 1) == 1);
  CHECK(clipped_cell_area(square, {10.5, 5.5}, 1) == 0);
  CHECK(clipped_cell_area(square, {10, 10}, 1) == 0.25);
  CHECK(clipped_cell_area(plate_with_square_hole(), {5.5, 5.5}, 1) == 0);
  CHECK(clipped_cell_area(ell(), {2, 2}, 2) == 3);
  const Outline triangle{{{{0, 0}, {4, 0}, {0, 4}}, {}}, {}};
  CHECK(clipped_cell_area(triangle, {2, 2}, 1) == Approx(0.5).epsilon(1e-15));
  CHECK(clipped_cell_area(plate_with_disc(0.25), {5, 5}, 1) == Approx(1 - std::numbers::pi / 16).epsilon(1e-14));
  CHECK(clipped_cell_area(plate_with_disc(3), {5, 5}, 1) == 0);
}

TEST_CASE("clipped_cell_area: cut into two pieces by a slit") {
  Outline comb{{{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 0.5}, {1, 0.5}, {1, 3}, {0, 3}}, {}}, {}};
  CHECK(clipped_cell_area(comb, {1.5, 2}, 2) == Approx(2).epsilon(1e-15));
}

TEST_CASE("clipped_cell_area: the cells of a plate add up to its area") {
  Outline plate = rectangle(0, 0, 10, 10);
  plate.holes.push_back(Circle{{2.7, 3.1}, 1.93, "a"});
  plate.holes.push_back(Circle{{8.2, 1.6}, 0.3, "b"});
  plate.holes.push_back(Polygon{{{5.1, 4.2}, {9.3, 6.6}, {7.4, 6.5}, {6.2, 9.7}}, {}});
  const double triangles = (4.2 * 2.3 - 2.4 * 2.3) / 2 + (2.3 * 5.5 - 2.3 * 1.1) / 2;  // about (5.1, 4.2)
  const double expected = 100 - std::numbers::pi * (1.93 * 1.93 + 0.09) - triangles;
  CHECK(area(plate) == Approx(expected).epsilon(1e-13));
  CHECK(sum_of_cells(plate, 10) == Approx(expected).epsilon(1e-12));
  CHECK(sum_of_cells(plate_with_square_hole(), 10) == Approx(96).epsilon(1e-14));
}

TEST_CASE("clipped_cell_area: a cell cut by a circle agrees with strips") {
  const Outline plate = plate_with_disc(2.5);
  const Point centre(6.5, 7);  // the circle runs through the centre
  const int strips = 20000;
  double expected = 0;
  for (int k = 0; k < strips; ++k) {
    const double x = 6 + (k + 0.5) / strips, y = 5 + std::sqrt(6.25 - (x - 5) * (x - 5));
    expected += std::min(1.0, std::max(0.0, 7.5 - y)) / strips;
  }
  // The midpoint rule errs by less than 1e-8 here: the integrand has kinks where the arc leaves the cell.
  CHECK(clipped_cell_area(plate, centre, 1) == Approx(expected).margin(1e-8));
}

TEST_CASE("leaves: past a re-entrant corner, touching it stays") {
  CHECK(leaves(ell(), {1, 3}, {3.5, 1}));
  CHECK_FALSE(leaves(ell(), {1, 3}, {3, 1}));  // touches (2, 2)
  CHECK_FALSE(leaves(ell(), {1, 3}, {2.5, 1}));
  CHECK_FALSE(leaves(ell(), {2, 1}, {2, 3.5}));  // along the edge
  CHECK_FALSE(leaves(ell(), {1, 1}, {2, 2}));    // ends in the corner
  CHECK(leaves(ell(), {1, 3}, {std::nextafter(3.0, 4.0), 1}));
}

TEST_CASE("leaves: a hole is crossed through edges, vertices or both, not by running along it") {
  const Outline plate = plate_with_square_hole();
  CHECK(leaves(plate, {3.5, 5}, {6.5, 5}));
  CHECK(leaves(plate, {3.5, 3.5}, {6.5, 6.5}));        // through two vertices
  CHECK_FALSE(leaves(plate, {3, 3}, {4.25, 8}));       // passes left of it
  CHECK(leaves(plate, {3.5, 3}, {5.5, 7}));            // in through the vertex (4, 4), out through an edge
  CHECK_FALSE(leaves(plate, {3.5, 4}, {6.5, 4}));      // along an edge
  CHECK_FALSE(leaves(plate, {3.5, 4.5}, {4.5, 3.5}));  // touches a vertex
  CHECK_FALSE(leaves(plate, {3.5, 4}, {3.75, 4}));     // on the line of an edge, before it
  Outline star = rectangle(0, 0, 10, 10);              // along one edge and into the hole beyond it
  star.holes.push_back(Polygon{{{3, 5}, {5, 5}, {5, 4}, {7, 4}, {7, 6}, {3, 6}}, {}});
  CHECK(leaves(star, {2, 5}, {8, 5}));
  CHECK_FALSE(leaves(star, {2, 5}, {4.5, 5}));
}

TEST_CASE("leaves: a chord of a circle leaves, a tangent does not") {
  const Outline plate = plate_with_disc(2.5);
  CHECK_FALSE(leaves(plate, {2, 7.5}, {8, 7.5}));
  CHECK(leaves(plate, {2, std::nextafter(7.5, 7.0)}, {8, std::nextafter(7.5, 7.0)}));
  CHECK_FALSE(leaves(plate, {6.5 - 4, 7 + 3}, {6.5 + 2, 7 - 1.5}));  // tangent at (6.5, 7)
}

TEST_CASE("leaves agrees with samples along the segment") {
  Outline plate = plate_with_square_hole();
  plate.holes.push_back(Circle{{2, 7}, 1.1, "a"});
  plate.holes.push_back(Polygon{{{6, 1}, {9, 2}, {7, 2}, {8, 3.5}}, {}});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> draw(0.01, 9.99);
  int tested = 0, left = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const Point p(draw(random), draw(random)), q(draw(random), draw(random));
    if (!contains(plate, p) || !contains(plate, q)) continue;
    int outside = 0;
    for (int k = 1; k < 400; ++k) outside += !contains(plate, p + (q - p) * (k / 400.0));
    const bool found = leaves(plate, p, q);
    if (outside > 0) REQUIRE(found);
    if (found && outside == 0) {  // a cut shorter than the step between samples
      int finer = 0;
      for (int k = 1; k < 100000; ++k) finer += !contains(plate, p + (q - p) * (k / 100000.0));
      REQUIRE(finer > 0);
    }
    ++tested;
    left += found;
  }
  CHECK(tested > 800);
  CHECK(left > 100);
}

TEST_CASE("re-entrant corners are those beyond 200 degrees, in any direction") {
  const std::vector<Point> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0.5, 2.05}, {0, 2}};
  for (const double degrees : {0.0, 31.0, 180.0}) {
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    auto outer = corners;
    for (auto& x : outer) x = Point(c * x.x() - s * x.y(), s * x.x() + c * x.y());
    const auto found = geometry::reentrant_corners(outer);
    REQUIRE(found.size() == 1);
    CHECK(found[0] == outer[3]);
  }
  CHECK(geometry::reentrant_corners({{0, 0}, {1, 0}, {1, 1}, {0.5, 0.95}, {0, 1}}).empty());  // 191 degrees
  CHECK(geometry::reentrant_corners({{0, 0}, {1, 0}, {1, 1}, {0.5, 0.5}, {0, 1}}).size() == 1);
}

TEST_CASE("re-entrant corners of holes: clockwise, sharp ones and not those of a polygon like a circle") {
  const std::vector<Point> hole{{0, 0}, {0, 1}, {1, 1}, {1, 0.8}, {0.2, 0.8}, {0.2, 0}};  // an L
  auto found = geometry::reentrant_corners(hole);
  CHECK(found.size() == 5);
  CHECK(std::ranges::find(found, Point(0.2, 0.8)) == found.end());
  std::vector<Point> round, square;
  for (int i = 0; i < 24; ++i)
    round.emplace_back(std::cos(i * std::numbers::pi / 12), -std::sin(i * std::numbers::pi / 12));
  for (int i = 0; i < 24; i += 6) square.push_back(round[std::size_t(i)]);
  CHECK(geometry::reentrant_corners(round).empty());
  CHECK(geometry::reentrant_corners(square).size() == 4);
  CHECK(geometry::singular_corners(plate_with_square_hole()).size() == 4);  // given counter-clockwise
  CHECK(geometry::singular_corners(plate_with_disc(1)).empty());
}

TEST_CASE("meet: sharing a point, in line or not") {
  CHECK(meet({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  CHECK(meet({0, 0}, {2, 0}, {1, 0}, {1, 1}));
  CHECK(meet({0, 0}, {2, 0}, {2, 0}, {3, 0}));
  CHECK(meet({0, 0}, {3, 0}, {1, 0}, {2, 0}));
  CHECK_FALSE(meet({0, 0}, {1, 0}, {2, 0}, {3, 0}));
  CHECK_FALSE(meet({0, 0}, {2, 0}, {1, 1e-300}, {1, 1}));
  CHECK_FALSE(meet({0, 0}, {1, 1}, {1, 0}, {0.6, 0.5}));
}
