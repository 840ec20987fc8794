#include "plate/edges/surface_plate.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;
using geometry::Point;

namespace {

const Section surface_section{200, 0.25, 0.3};

SurfacePlate small_plate(double width = 2, double height = 1.5) {
  Discretization d;
  d.spacing = 0.25;
  return surface_plate(surface_section, d, {0, 0}, {width, height});
}

Eigen::Vector3d pressure(const Point&) {
  return {1, 0, 0};
}

}  // namespace

TEST_CASE("surface plate: points and edges of a rectangle, on the lattice and off it") {
  const auto p = small_plate();
  CHECK(p.body.real == 8 * 6);
  CHECK(p.body.surface.size() == 2 * (8 + 6));
  CHECK(p.at(0).isApprox(Point(0.125, 0.125)));
  CHECK(p.at(p.body.real - 1).isApprox(Point(1.875, 1.375)));
  for (int s = 0; s < int(p.body.surface.size()); ++s) CHECK(std::abs(p.beyond(s)) < 1e-12);
  const auto off = rectangle_body({0.1, 0}, {2.1, 1.55}, {0, 0}, 0.25, 3);
  CHECK(off.real == 8 * 6);
  CHECK(off.surface[std::size_t(off.surface_node(0, 0, -1))].distance == Approx(0.1));
  CHECK(off.surface[std::size_t(off.surface_node(off.real - 1, 0, 1))].distance == Approx(0.9));
  CHECK(off.surface[std::size_t(off.surface_node(off.real - 1, 1, 1))].distance == Approx(0.7));
  CHECK_THROWS_AS(rectangle_body({0, 0}, {0.1, 1}, {0, 0}, 0.25, 3), Refused);
}

TEST_CASE("surface plate: reactions of a clamped plate under pressure are its load, by symmetry a quarter from each") {
  for (const auto rule : {FluxRule::crossing_point, FluxRule::lever}) {
    auto p = small_plate(1.5, 1.5);
    p.rule = rule;
    const auto clamped = [](const Point&, const Point&) { return edge_condition(SupportKind::clamped); };
    const auto problem = edge_problem(p, clamped, pressure);
    const auto result = solution(p, clamped, pressure);
    CHECK(problem.held.size() == 3 * p.body.surface.size());
    double reaction = 0, left = 0;
    for (std::size_t i = 0; i < problem.held.size(); ++i) {
      if (problem.held[i].unknown % 3 != 0) continue;
      reaction += result.reactions[Eigen::Index(i)];
      const int s = int(problem.held[i].unknown) / 3 - p.body.real;
      if (p.normal(s).x() < 0) left += result.reactions[Eigen::Index(i)];
    }
    // the lever leaves out what of bonds across corners falls beside both edges
    CHECK(reaction ==
          Approx(rule == FluxRule::lever ? -2.2282 : -1.5 * 1.5).epsilon(rule == FluxRule::lever ? 1e-4 : 1e-9));
    CHECK(left == Approx(reaction / 4).epsilon(1e-9));
  }
}

TEST_CASE("surface plate: an edge beyond the points carries its strip's load") {
  Discretization d;
  d.spacing = 0.25;
  auto p = surface_plate(surface_section, d, {0, 0}, {2.05, 1.5});
  const auto all_free = [](const Point&, const Point&) { return edge_condition(SupportKind::free); };
  const auto right = edge_problem(p, all_free, pressure).right;
  double sum = 0;
  for (int i = 0; i < int(right.size()); i += 3) sum += right[i];
  CHECK(sum == Approx(2.05 * 1.5).epsilon(1e-12));
}

TEST_CASE("surface plate: too few points for an order, orders without meaning, and loose plates are refused") {
  const auto all = [](SupportKind kind) { return [=](const Point&, const Point&) { return edge_condition(kind); }; };
  auto p = small_plate(0.75, 1.5);
  CHECK_NOTHROW(stiffness(p));
  p.orders = {4, 3};
  CHECK_THROWS_AS(stiffness(p), Refused);
  p.orders = {2, 0};
  CHECK_THROWS_AS(stiffness(p), std::invalid_argument);
  p.orders = {1, 1};
  CHECK_THROWS_AS(stiffness(p), std::invalid_argument);
  CHECK_THROWS_AS(solution(small_plate(), all(SupportKind::free), pressure), Refused);
  CHECK_THROWS_AS(solution(small_plate(), all(SupportKind::symmetry), pressure), Refused);
}
