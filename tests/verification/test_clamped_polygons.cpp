// Clamped on all sides by general images: polygons of any number of edges, turned by any angle, between the clamped
// circles inside and around them; squares in any direction beside the square along the lattice.
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

geometry::Outline polygon(int edges, double turn, double radius) {
  geometry::Outline outline;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * (k + turn) / edges;
    outline.outer.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    outline.outer.edge_names.push_back("edge" + std::to_string(k));
  }
  return outline;
}

/// Largest deflection of a polygon whose edges are all clamped.
double deflection(const geometry::Outline& outline, double spacing) {
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
    const double w = deflection(polygon(edges, turn, 1), spacing);
    CAPTURE(edges, spacing, turn, w / circle_deflection(1), w / circle_deflection(inside));
    // of the second order, as edges on the lattice: -1.7 and -0.4 %; measured: 2.4 and 0.5 % below
    CHECK(w > (1 - 12 * spacing * spacing) * circle_deflection(inside));
    CHECK(w < circle_deflection(1));
  }
}

TEST_CASE("a clamped square deflects alike in any direction") {
  const auto [spacing, within] = GENERATE(std::pair(0.04, 0.01), std::pair(0.02, 0.002));  // measured: 0.61, 0.14 %
  const double straight = deflection(polygon(4, 0.5, std::sqrt(2)), spacing);
  for (const double degrees : {1, 5, 10, 20, 27, 38, 45}) {
    const double w = deflection(polygon(4, 0.5 + degrees / 90, std::sqrt(2)), spacing);
    CAPTURE(spacing, degrees, w / straight);
    CHECK(w == Approx(straight).epsilon(within));
  }
}
