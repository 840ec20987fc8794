// Loads on a part of the plate against Navier's series: hard simple supports all round, 2 x 2.

#include "plate/formulations.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

namespace {

constexpr double side = 2, pi = std::numbers::pi;

/// int_from^to (c + g t) sin(k t) dt
double sine(double from, double to, double k, double c = 1, double g = 0) {
  const auto at = [&](double t) { return -(c + g * t) * std::cos(k * t) / k + g * std::sin(k * t) / (k * k); };
  return at(to) - at(from);
}

/// Deflection at x of the plate 0 ... side under a load with the coefficients 4 / side^2 of(m, n).
template <typename Of>
double series(const Point& x, const Of& of) {
  const double D = vp::section.bending_stiffness(), S = vp::section.shear_stiffness();
  double sum = 0;
  for (int m = 1; m < 240; ++m)
    for (int n = 1; n < 240; ++n) {
      const double a = m * pi / side, b = n * pi / side, k = a * a + b * b;
      sum += 4 / (side * side) * of(a, b) / (D * k * k) * (1 + D * k / S) * std::sin(a * x.x()) * std::sin(b * x.y());
    }
  return sum;
}

/// Largest error of w over its largest value, at the points next to some places.
template <typename Of>
double error(const Load& load, double spacing, const FormulationKind* kind, const Of& of) {
  auto c = vp::square(spacing);
  c.discretization.formulation = kind;
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  c.loads = {load};
  const auto plate = vp::assembled(c);
  const auto solution = vp::solved(*plate);
  REQUIRE(solution.converged);
  double worst = 0, largest = 0;
  for (const Point& place : {Point(0, 0), Point(0.3, -0.5), Point(-0.42, 0.2), Point(0.7, 0.7)}) {
    const auto k = geometry::nearest_plate_point(plate->cloud(), place);
    const double exact = series(plate->cloud().positions[k] + Point(1, 1), of);
    worst = std::max(worst, std::abs(solution.state(0, Eigen::Index(k)) - exact));
    largest = std::max(largest, std::abs(exact));
  }
  return worst / largest;
}

/// Errors at 20 and 40 cells a side are below these, for bonds and the Galerkin plate: of the second order.
template <typename Of>
void check(const Load& load, const Of& of, std::array<double, 2> bonds, std::array<double, 2> galerkin) {
  for (const auto* kind : formulations()) {
    const auto& most = kind->offers(Feature::horizon) ? bonds : galerkin;
    const double coarse = error(load, 0.1, kind, of), fine = error(load, 0.05, kind, of);
    CAPTURE(kind->name, coarse, fine);
    CHECK(coarse < most[0]);
    CHECK(fine < most[1]);
  }
}

}  // namespace

TEST_CASE("loads: pressure on a rectangle that grows along x, edges anywhere among the points") {
  const Load load{
      Pressure{.value = 2,
               .gradient = {3, 0},
               .from = {-0.63, 0},
               .patch = geometry::Polygon{{{-0.63, -0.11}, {0.22, -0.11}, {0.22, 0.57}, {-0.63, 0.57}}, {}}}};
  check(load, [](double a, double b) { return sine(0.37, 1.22, a, 2 - 3 * 0.37, 3) * sine(0.89, 1.57, b); },
        {0.025, 0.005},    // measured: 2.19, 0.44 %
        {0.002, 0.0005});  // measured: 0.16, 0.041 %
}

TEST_CASE("loads: water up to three fifths of the height") {
  const Load load{Pressure{.value = 12,
                           .gradient = {0, -10},
                           .from = {0, -1},
                           .patch = geometry::Polygon{{{-1, -1}, {1, -1}, {1, 0.2}, {-1, 0.2}}, {}}}};
  check(load, [](double a, double b) { return sine(0, 2, a) * sine(0, 1.2, b, 12, -10); },
        {0.025, 0.005},     // measured: 2.18, 0.42 %
        {0.0015, 0.0004});  // measured: 0.12, 0.036 %
}

TEST_CASE("loads: a line load") {
  const Load load{LineLoad{.along = {{-0.71, 0.13}, {0.38, 0.13}}, .value = 5}};
  check(load, [](double a, double b) { return 5 * sine(0.29, 1.38, a) * std::sin(b * 1.13); },
        {0.025, 0.0065},   // measured: 2.26, 0.56 %
        {0.009, 0.0035});  // measured: 0.83, 0.28 %
}

TEST_CASE("loads: an expression that is one term of the series") {
  const Load load{Pressure{.formula = Formula("cos(pi * x / 2) * cos(pi * y / 2)")}};
  const auto first = [](double a, double b) { return a + b < 1.001 * pi ? 1.0 : 0.0; };
  check(load, first, {0.025, 0.005},  // measured: 2.00, 0.39 %
        {0.002, 0.0005});             // measured: 0.10, 0.029 %
  for (const auto* kind : formulations()) {
    CAPTURE(kind->name);
    CHECK(error(load, side / 100, kind, first) < 0.001);  // measured: bonds 0.057 %, Galerkin 0.005 %
  }
}

TEST_CASE("mass and pressure of plates in any direction are those of the outline") {
  for (const double degrees : {0.0, 10.0, 23.0, 45.0})
    for (const double width : {1.0, 1.013}) {
      auto outline = geometry::rectangle(0, 0, width, 0.7);
      outline.holes.push_back(geometry::Circle{{0.4, 0.3}, 0.17, "hole0"});
      const Eigen::Rotation2Dd turned(degrees * pi / 180);
      const auto place = [&](const Point& x) -> Point { return turned * x; };
      outline = geometry::placed(outline, place, 1);
      for (const auto* kind : formulations()) {
        auto c = vp::free_plate(outline, 0.025);
        c.discretization.formulation = kind;
        c.loads = {Load{Pressure{.value = 1}}};
        const auto plate = vp::assembled(c);
        const double exact = geometry::area(outline);
        const double mass = plate->mass().row(0).head(Eigen::Index(plate->cloud().plate_points)).sum();
        CAPTURE(kind->name, degrees, width);
        // 1e-7: coordinates of bonds are rounded; cells of the Galerkin plate follow circles by chords
        const double within = kind->offers(Feature::horizon) ? 1e-7 : 0.001;
        CHECK(mass == Approx(c.section.density * c.section.thickness * exact).epsilon(within));
        CHECK(plate->total_load().row(0).sum() == Approx(exact).epsilon(within));
      }
    }
}
