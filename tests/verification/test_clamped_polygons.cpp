// Clamped on all sides by general images: polygons of any number of edges, turned by any angle, between the clamped
// circles inside and around them.
#include <numbers>

#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// In the middle of a clamped circular Mindlin plate under pressure 1 (Timoshenko and Woinowsky-Krieger (1959),
/// section 16, and its part of shear).
double circle_deflection(double radius) {
  const double bending = vp::section.bending_stiffness(), shear = vp::section.shear_stiffness();
  return std::pow(radius, 4) / (64 * bending) + radius * radius / (4 * shear);
}

/// Largest deflection of a regular polygon in the circle of radius 1, all of its edges clamped.
double polygon_deflection(int edges, double turn, double spacing) {
  geometry::Outline outline;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * (k + turn) / edges;
    outline.outer.vertices.emplace_back(std::cos(angle), std::sin(angle));
    outline.outer.edge_names.push_back("edge" + std::to_string(k));
  }
  auto c = vp::free_plate(outline, spacing);
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.supports = {vp::held(SupportKind::clamped, outline.outer.edge_names)};
  const auto a = vp::assembled(c);
  const auto solution = vp::solved(*a);
  REQUIRE(solution.converged);
  return solution.state.row(0).head(Eigen::Index(a->cloud().plate_points)).maxCoeff();
}

}  // namespace

TEST_CASE("a clamped polygon deflects between the clamped circles inside and around it") {
  const int edges = GENERATE(8, 12, 16, 24, 32, 48, 64, 96);
  const double spacing = GENERATE(0.05, 0.025);
  const double inside = std::cos(std::numbers::pi / edges);
  for (const double turn : {0.13, 0.37, 0.61}) {
    const double w = polygon_deflection(edges, turn, spacing);
    CAPTURE(edges, spacing, turn, w / circle_deflection(1), w / circle_deflection(inside));
    CHECK(w > 0.98 * circle_deflection(inside));
    CHECK(w < 1.02 * circle_deflection(1));
  }
}
