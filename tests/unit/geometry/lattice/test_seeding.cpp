#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "geometry/lattice/cloud.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("lattice: cell centres row by row from the lower left") {
  const Cloud cloud = lattice(rectangle(1, 2, 4, 4), 1);
  REQUIRE(cloud.size() == 6);
  CHECK(cloud.plate_points == 6);
  CHECK(cloud.units.origin == Point(1, 2));
  CHECK(cloud.positions[0] == Point(1.5, 2.5));
  CHECK(cloud.positions[2] == Point(3.5, 2.5));
  CHECK(cloud.positions[3] == Point(1.5, 3.5));
  for (double a : cloud.areas) CHECK(a == 1.0);
}

TEST_CASE("lattice: decimal spacing gives the number of cells that was meant, all of full area") {
  const Cloud cloud = lattice(rectangle(-1, -1, 1, 1), 0.008);
  CHECK(cloud.size() == 250 * 250);
  CHECK(std::all_of(cloud.areas.begin(), cloud.areas.end(), [](double a) { return a == 0.008 * 0.008; }));
  CHECK(sum(cloud.areas) == Approx(4).epsilon(1e-12));
  CHECK(cloud.units.to_lattice(cloud.positions[251]) == Point(1.5, 1.5));
}

TEST_CASE("lattice: boundary cells carry the part of their area in the plate") {
  const Cloud cloud = lattice(rectangle(0, 0, 2.75, 1), 1);
  REQUIRE(cloud.size() == 3);
  CHECK(cloud.areas[1] == 1.0);
  CHECK(cloud.areas[2] == Approx(0.75).epsilon(1e-15));
  const Cloud half = lattice(rectangle(0, 0, 2.5, 1), 1);
  REQUIRE(half.size() == 2);  // a centre on the boundary is outside
  CHECK(half.areas[1] == Approx(1.5).epsilon(1e-15));
}

TEST_CASE("lattice: the points of a test of every cell, with areas that add up to that of the plate") {
  Outline plate{{{{0, 0}, {9.3, 0.4}, {8.7, 4.1}, {4.5, 3.9}, {4.2, 8.8}, {0.2, 9.1}}, {}}, {}};
  plate.holes.push_back(Circle{{2.1, 2.2}, 1.3, "hole0"});
  plate.holes.push_back(Polygon{{{5, 1}, {7, 1.5}, {6, 2.75}}, {}});
  const double spacing = 0.13;
  const Cloud cloud = lattice(plate, spacing);
  const Outline cells = to_lattice(plate, cloud.units);
  std::size_t k = 0;
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 80; ++i) {
      const Point centre(i + 0.5, j + 0.5);
      if (!contains(cells, centre)) continue;
      REQUIRE(k < cloud.size());
      REQUIRE(cloud.units.to_lattice(cloud.positions[k]) == centre);
      // at an edge with what lies beside the cell in cells without a point
      const double own = spacing * spacing * clipped_cell_area(cells, centre, 1);
      const bool beside = distance_to_boundary(cells, centre) < 2;
      REQUIRE(cloud.areas[k] >= own * (1 - 1e-12));
      REQUIRE(cloud.areas[k] < (beside ? 2.5 * spacing * spacing : own * (1 + 1e-12)));
      ++k;
    }
  CHECK(sum(cloud.areas) == Approx(spacing * spacing * area(cells)).epsilon(1e-12));
  CHECK(k == cloud.size());
  CHECK(k > 1000);
}

TEST_CASE("lattice: no cell centre inside, or no spacing") {
  CHECK_THROWS_AS(lattice(rectangle(0, 0, 1, 1), 3), std::invalid_argument);
  CHECK_THROWS_AS(lattice(rectangle(0, 0, 1, 1), 0), std::invalid_argument);
}

TEST_CASE("lattice units: rounded to 2^-20, and back") {
  const LatticeUnits units{{-1, -1}, 0.008};
  CHECK(units.to_lattice({0.3, 0}) == Point(162.5, 125));
  CHECK((units.from_lattice({162.5, 125}) - Point(0.3, 0)).norm() < 1e-15);
  CHECK(LatticeUnits{}.to_lattice({1.0 / 3, 0}).x() * (1 << 20) == std::round((1 << 20) / 3.0));
  Outline plate = rectangle(-1, -1, 1, 1);
  plate.holes.push_back(Circle{{0.1, 0.1}, 0.3, "hole0"});
  const Outline cells = to_lattice(plate, units);
  CHECK(cells.outer.vertices[2] == Point(250, 250));
  CHECK(cells.outer.edge_names == plate.outer.edge_names);
  CHECK(std::get<Circle>(cells.holes[0]).radius == 37.5);
}

TEST_CASE("nearest_plate_point ignores fictitious points") {
  Cloud cloud = lattice(rectangle(0, 0, 4, 4), 1);
  cloud.positions.emplace_back(-0.5, 0.5);
  cloud.areas.push_back(1);
  CHECK(nearest_plate_point(cloud, {-0.5, 0.5}) == 0);
  CHECK(nearest_plate_point(cloud, {2.6, 1.4}) == 6);
}
