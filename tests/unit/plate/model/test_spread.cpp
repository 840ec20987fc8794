#include "plate/model/load_integration.hpp"

#include <numbers>

#include "geometry/cells/tessellation.hpp"
#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// Work on the three rigid motions: the resultant force, and its moments sum F x, sum F y with the couples.
Eigen::Vector3d spread_resultant(const Forces& forces, const std::vector<Point>& positions) {
  Eigen::Vector3d sum(0, 0, 0);
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    const Point& x = positions[std::size_t(k)];
    sum += Eigen::Vector3d(forces(0, k), forces(0, k) * x.x() - forces(2, k), forces(0, k) * x.y() + forces(1, k));
  }
  return sum;
}

const auto outline = geometry::rectangle(-0.2, 0.1, 1.8, 1.3);

/// By points in cells, and by squares and triangles between points that lie on edges, alike and graded.
std::vector<Eigen::Vector3d> resultants(const Load& load) {
  const auto cloud = geometry::lattice(outline, 0.1);
  std::vector<Eigen::Vector3d> result{spread_resultant(nodal_forces(load, cloud, outline), cloud.positions)};
  for (const geometry::Grading& grading : {geometry::Grading{}, geometry::Grading{0.03, std::nullopt, 0.2}}) {
    const auto cells = geometry::tessellation(outline, {}, 0.1, {{0.33, 0.47}}, grading);
    const std::vector<double> areas(cells.positions.size());  // of uniform pressures alone
    result.push_back(spread_resultant(nodal_forces(load, cells, areas), cells.positions));
  }
  return result;
}

Load by_formula(const std::string& formula) {
  return {Pressure{.formula = Formula(formula)}};
}

Eigen::Vector3d pressed(const Pressure& pressure, const std::vector<Point>& ring) {
  const auto m = geometry::moments(ring, {0, 0});
  const Point growing = m.second * pressure.gradient;
  return pressure.at({0, 0}) * Eigen::Vector3d(m.area, m.first.x(), m.first.y()) +
         Eigen::Vector3d(pressure.gradient.dot(m.first), growing.x(), growing.y());
}

void check_spread(const Load& load, const Eigen::Vector3d& expected) {
  for (const auto& found : resultants(load)) {
    CAPTURE(found.transpose(), expected.transpose());
    CHECK((found - expected).norm() < 1e-12);  // measured: 3e-14 at most
  }
}

}  // namespace

TEST_CASE("a pressure that grows has its resultant and the moments of this") {
  const Pressure pressure{.value = 3, .gradient = {-1.5, 4}, .from = {0.3, 0.2}};
  check_spread(Load{pressure}, pressed(pressure, outline.outer.vertices));
}

TEST_CASE("a pressure on a patch has its resultant and moments, wherever the patch lies on the points") {
  Pressure pressure{.value = 3, .gradient = {-1.5, 4}, .from = {0.3, 0.2}};
  const std::vector<Point> triangle{{0.01, 0.33}, {1.37, 0.21}, {0.9, 1.11}};
  const std::vector<Point> bent{{0, 0.4}, {1, 0.4}, {1, 0.5}, {0.1, 0.5}, {0.1, 1}, {0, 1}};
  for (const auto& ring : {triangle, bent}) {
    pressure.patch = geometry::Polygon{ring, {}};
    check_spread(Load{pressure}, pressed(pressure, ring));
  }
  pressure.patch = geometry::Circle{{0.9, 0.7}, 0.23, ""};
  check_spread(Load{pressure}, pressed(pressure, geometry::Patch(*pressure.patch).ring()));
}

TEST_CASE("a patch beyond the plate acts on what there is of the plate, one over all of it is the pressure") {
  Pressure pressure{.value = 3, .patch = geometry::Polygon{{{1.55, -5}, {9, -5}, {9, 5}, {1.55, 5}}, {}}};
  check_spread(Load{pressure}, pressed(pressure, {{1.55, 0.1}, {1.8, 0.1}, {1.8, 1.3}, {1.55, 1.3}}));
  pressure.patch = geometry::Polygon{{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {}};
  const Load load{pressure}, everywhere{Pressure{.value = 3}};
  const auto cloud = geometry::lattice(outline, 0.1);
  CHECK((nodal_forces(load, cloud, outline) - nodal_forces(everywhere, cloud, outline)).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("a line load has its resultant and moments") {
  LineLoad load{.along = {{-0.2, 0.3}, {0.61, 0.37}, {0.7, 1.3}}, .value = -7};
  Eigen::Vector3d expected(0, 0, 0);
  for (std::size_t i = 0; i + 1 < load.along.size(); ++i) {
    const Point middle = (load.along[i] + load.along[i + 1]) / 2;
    expected += load.value * (load.along[i + 1] - load.along[i]).norm() * Eigen::Vector3d(1, middle.x(), middle.y());
  }
  check_spread(Load{load}, expected);
  load.along = {{7, 7}, {8, 8}};
  CHECK_THROWS_AS(nodal_forces(Load{load}, geometry::lattice(outline, 0.1), outline), Refused);
}

TEST_CASE("a line load across a crack gives each side what lies on it, with its moments") {
  const std::vector<Point> crack{{0.3, 0.41}, {1.4, 0.83}};
  const Point along = (crack[1] - crack[0]).normalized(), left(-along.y(), along.x());
  const auto side = [&](const Point& x) { return left.dot(x - crack[0]) > 0; };
  const auto paths = std::vector<geometry::CrackPath>{{crack, geometry::End::tip, geometry::End::tip}};
  for (const double turn : {0.1, 0.9, 1.7, 2.6}) {
    const Point cross = crack[0] + 0.613 * (crack[1] - crack[0]), way(std::cos(turn), std::sin(turn));
    const LineLoad line_load{.along = {cross - 0.17 * way, cross + 0.23 * way}, .value = 2};
    const Load load{line_load};
    const auto check_sides = [&](const Forces& forces, const std::vector<Point>& seen, const std::vector<Point>& at) {
      for (const bool above : {true, false}) {
        Forces own = forces;
        for (Eigen::Index k = 0; k < own.cols(); ++k)
          if (side(seen[std::size_t(k)]) != above) own.col(k).setZero();
        const bool ahead = side(line_load.along[1]) == above;
        const double length = ahead ? 0.23 : 0.17;
        const Point middle = cross + (ahead ? 0.5 : -0.5) * length * way;
        const Eigen::Vector3d expected = line_load.value * length * Eigen::Vector3d(1, middle.x(), middle.y());
        CAPTURE(turn, above);
        CHECK((spread_resultant(own, at) - expected).norm() < 1e-12);  // measured: 2e-15
      }
    };
    const auto cloud = geometry::lattice(outline, 0.1);
    check_sides(nodal_forces(load, cloud, outline, {}, paths), cloud.positions, cloud.positions);
    for (const geometry::Grading& grading : {geometry::Grading{}, geometry::Grading{0.03, std::nullopt, 0.2}}) {
      const auto cells = geometry::tessellation(outline, paths, 0.1, {}, grading);
      const std::vector<double> areas(cells.positions.size());
      check_sides(nodal_forces(load, cells, areas), geometry::positions_inside_faces(cells), cells.positions);
    }
  }
}

TEST_CASE("spread: expressions do what pressures by values do, on parts too, and their own curves on the whole") {
  const geometry::Circle patch{{0.7, 0.6}, 0.3, ""};
  const Load value{Pressure{.value = 2, .gradient = {-1, 3}, .from = {0.1, 0.2}, .patch = patch}},
      formula{Pressure{.formula = Formula("2 - (x - 0.1) + 3 * (y - 0.2)"), .patch = patch}};
  const auto expected = resultants(value), found = resultants(formula);
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK((found[i] - expected[i]).norm() < 1e-12);      // measured: 1e-15 at most
  const auto all = resultants(by_formula("x * x * y"));  // (1.8^3 + 0.2^3) / 3 (1.3^2 - 0.1^2) / 2
  for (const auto& one : all) CHECK(one[0] == Approx((5.832 + 0.008) / 3 * (1.69 - 0.01) / 2).epsilon(1e-3));
  CHECK_THROWS_AS(resultants(by_formula("1 / (x - x)")), FormulaError);
  CHECK_THROWS_AS(resultants(by_formula("1 / (x - 0.3)")), FormulaError);  // 0.3 lies on points but for rounding
  // neither has too large a value anywhere, but nobody knows the sum of the first
  CHECK_THROWS_AS(resultants(by_formula("exp(-1e6 * ((x - 0.3)^2 + (y - 0.4)^2))")), FormulaError);
  CHECK_NOTHROW(resultants(by_formula("x > 0.3 ? 1e9 : 0")));
}

TEST_CASE("spread: expressions that vary within cells have their resultants all the same, or are refused") {
  const Load wave = by_formula("1 + sin(60 * pi * x)");  // three waves per spacing
  // widths of half and a quarter of the spacing, at no point
  const Load peak = by_formula("exp(-((x - 0.512)^2 + (y - 0.437)^2) / (2 * 0.05^2))"),
             narrower = by_formula("exp(-((x - 0.512)^2 + (y - 0.437)^2) / (2 * 0.0125^2))");
  const Load jump = by_formula("x + 0.5 * y < 1.03 ? 1 : 0");
  const double whole = std::numbers::pi * 2 * 0.05 * 0.05, cut = 0.5 * (1.18 + 0.58) * 1.2;
  for (const auto& found : resultants(wave)) CHECK(found[0] == Approx(2 * 1.2).epsilon(1e-4));
  for (const auto& found : resultants(peak)) {
    CHECK(found[0] == Approx(whole).epsilon(2e-4));
    CHECK(found[1] == Approx(0.512 * whole).epsilon(2e-4));
  }
  for (const auto& found : resultants(jump)) CHECK(found[0] == Approx(cut).epsilon(1e-3));
  for (const auto& found : resultants(narrower)) CHECK(found[0] == Approx(whole / 16).epsilon(2e-3));
  // nothing that triangles of a thousandth of a cell would show
  CHECK_THROWS_AS(resultants(by_formula("sin(1e9 * x * y) > 0 ? 1 : 0")), FormulaError);
  CHECK_THROWS_AS(resultants(by_formula("1 / (x - 0.317)^2")), FormulaError);
}
