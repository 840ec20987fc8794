#include "plate/formulation/springs_and_stiffeners.hpp"

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/mechanisms.hpp"
#include "plate/formulation/pieces.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

namespace {

const std::vector<const FormulationKind*> both{&galerkin, &ordinary};

cases::Case free_square(const FormulationKind& kind) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
  c.discretization.formulation = &kind;
  return c;
}

Spring springs(double w, double normal, double tangential, std::vector<std::string> edges, geometry::Polyline along,
               std::optional<Point> position = {}) {
  return {w, normal, tangential, position ? normal : 0, std::move(edges), std::move(along), position};
}

/// w = c + g . x with psi = grad w.
State rigid(const Formulation& plate, double c, const Point& g) {
  return vp::field(plate, [&](const Point& x) { return Eigen::Vector3d(c + g.dot(x), g.y(), -g.x()); });
}

}  // namespace

TEST_CASE("a load on an edge with stiff springs moves it by the load over their stiffness") {
  for (const auto* kind : both)
    for (const bool force : {true, false}) {
      auto c = free_square(*kind);
      c.analysis.kind = cases::Analysis::Kind::static_;
      c.section = {1, 0, 0.3, 5.0 / 6, 1};
      c.springs = {springs(force ? 300 : 0, force ? 0 : 30, 0, {"right"}, {})};
      c.supports = {vp::held(SupportKind::simply_supported, {"bottom", "top", "left"})};
      c.loads = {force ? Load{EdgeShear{.edges = {"right"}, .value = 0.003}}
                       : Load{EdgeMoment{.edges = {"right"}, .value = 0.003}}};
      const auto plate = vp::assembled(c);
      const auto u = value_at(plate->interpolation({0.999, 0.5}), vp::solved(*plate).state);
      CAPTURE(kind->name, force, u);
      if (force)
        CHECK(u[0] == Approx(1e-5).epsilon(0.05));  // measured: 1.025e-5, 1.007e-5
      else
        CHECK(std::abs(u[2]) == Approx(1e-4).epsilon(0.2));  // measured: 1.00e-4, 1.16e-4
    }
}

TEST_CASE("springs have their energy under rigid motions") {
  const Point g(0.7, -0.4);
  const double c = 0.3;
  const auto square = [](double x) { return x * x; };
  const auto w = [&](double x, double y) { return c + g.dot(Point(x, y)); };
  // the square of a linear function over a length: Simpson's rule
  const auto line = [&](double a, double b, double d) { return (square(a) + 4 * square(b) + square(d)) / 6; };
  for (const auto* kind : both) {
    auto content = free_square(*kind);
    content.section.young = 1e12;  // what lies between points and edges gives way in a plate that is not rigid
    content.springs = {springs(3, 5, 7, {"left", "top"}, {}), springs(3, 5, 7, {}, {{0.13, 0.2}, {0.13, 0.9}}),
                       springs(3, 5, 0, {}, {}, Point(0.42, 0.77))};
    const auto plate = vp::assembled(content);
    const State u = rigid(*plate, c, g);
    const auto& parts = plate->boundary().elastic_supports.parts();
    const double edges = 3 * (line(w(0, 0), w(0, 0.5), w(0, 1)) + line(w(0, 1), w(0.5, 1), w(1, 1))) +
                         5 * g.squaredNorm() + 7 * g.squaredNorm();
    CHECK(parts[0]->energy(u) == Approx(edges / 2).epsilon(3e-4));  // measured: 2e-4 of bonds, by one place per spacing
    const double along =
        0.7 * (3 * line(w(0.13, 0.2), w(0.13, 0.55), w(0.13, 0.9)) + 5 * square(g.x()) + 7 * square(g.y()));
    CHECK(parts[1]->energy(u) == Approx(along / 2).epsilon(1e-4));
    CHECK(parts[2]->energy(u) == Approx((3 * square(w(0.42, 0.77)) + 5 * g.squaredNorm()) / 2).epsilon(1e-12));
    CHECK(parts[0]->name == "spring0");
    CHECK(parts[2]->position.has_value());
  }
}

TEST_CASE("plates are held by foundations and springs, or told how they can move") {
  for (const auto* kind : both) {
    const auto free_modes = [&](std::vector<Foundation> soil, std::vector<Spring> feet) {
      auto c = free_square(*kind);
      c.foundations = std::move(soil), c.springs = std::move(feet);
      return vp::assembled(c)->pieces().front().free_modes;
    };
    CHECK(free_modes({}, {}) == 3);
    CHECK(free_modes({{1e-6, 0, {}}}, {}) == 0);
    CHECK(free_modes({{1e6, 1, geometry::Circle{{0.8, 0.8}, 0.05, ""}}}, {}) == 0);
    CHECK(free_modes({}, {springs(1, 0, 0, {"left"}, {})}) == 1);  // turns about the edge
    CHECK(free_modes({}, {springs(1, 1e-3, 0, {"left"}, {})}) == 0);
    CHECK(free_modes({}, {springs(0, 1, 0, {"left"}, {})}) == 2);
    CHECK(free_modes({}, {springs(1, 0, 0, {}, {}, Point(0.4, 0.3))}) == 2);
    CHECK(free_modes({}, {springs(1, 1, 0, {}, {}, Point(0.4, 0.3))}) == 0);
    const std::vector<Spring> feet{springs(1, 0, 0, {}, {}, Point(0.1, 0.1)), springs(9, 0, 0, {}, {}, Point(0.9, 0.1)),
                                   springs(2, 0, 0, {}, {}, Point(0.5, 0.9))};
    CHECK(free_modes({}, feet) == 0);
  }
}

TEST_CASE("soil under one piece of a plate holds that one alone") {
  for (const auto* kind : both) {
    auto c = free_square(*kind);
    c.cracks = {{{0.5, 0}, {0.5, 1}}};
    c.foundations = {{2, 1, geometry::Polygon{{{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}, {"", "", "", ""}}}};
    const auto plate = vp::assembled(c);
    REQUIRE(plate->pieces().size() == 2);
    CHECK(plate->pieces()[0].free_modes + plate->pieces()[1].free_modes == 3);
    CHECK(loose(*plate).size() == 1);
    c.foundations = {{2, 1, {}}};
    CHECK(loose(*vp::assembled(c)).empty());
  }
}

TEST_CASE("the plate's forces are the derivative of its energy, with what is attached") {
  for (const auto* kind : both) {
    auto c = free_square(*kind);
    c.foundations = {{30, 4, geometry::Circle{{0.4, 0.6}, 0.31, ""}}};
    c.springs = {springs(3, 5, 7, {"left", "top"}, {}), springs(3, 5, 0, {}, {}, Point(0.42, 0.77))};
    const auto plate = vp::assembled(c);
    const State u = vp::random_state(*plate, 1), v = vp::random_state(*plate, 2);
    Forces force;
    plate->internal_force(u, force);
    const double step = 1e-3;  // the energy is quadratic: central differences are exact but for rounding
    const double change = (plate->strain_energy(u + step * v) - plate->strain_energy(u - step * v)) / (2 * step);
    CHECK(-force.cwiseProduct(v).sum() == Approx(change).epsilon(1e-9));
    Forces own = force;
    plate->boundary().elastic_supports.take_force(u, own);
    c.foundations.clear(), c.springs.clear();
    const auto bare = vp::assembled(c);
    if (kind == &galerkin) continue;  // there a spring has a point of its own
    Forces expected;
    bare->internal_force(u, expected);
    CHECK((own - expected).norm() < 1e-12 * expected.norm());
  }
}
