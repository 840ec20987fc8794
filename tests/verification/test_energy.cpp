// The internal force is the derivative of the strain energy, and the stiffness is symmetric, through all constraints.

#include "plate/formulation/constraints.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// Largest |P^T f + dU/dq| over the free degrees of freedom, relative to the largest |P^T f|.
double force_error(const Formulation& a) {
  const auto& constraints = a.constraints();
  const State u = vp::random_state(a, 31);
  const Forces force = vp::folded_force(a, u);
  double worst = 0;
  std::size_t compared = 0;
  for (Eigen::Index n = 0; n < u.size(); ++n) {
    if (constraints.held(dof_by_points(n))) continue;
    double difference = 0;
    for (const double step : {1.0, -1.0}) {  // any step: the energy is quadratic
      State moved = u;
      plate::at_dof(moved, plate::dof_by_points(n)) += step;
      constraints.impose(moved);
      difference += step * a.energies(moved).sum() / 2;
    }
    worst = std::max(worst, std::abs(plate::at_dof(force, plate::dof_by_points(n)) + difference));
    ++compared;
  }
  REQUIRE(compared > 100);
  REQUIRE(force.cwiseAbs().maxCoeff() > 1);
  return worst / force.cwiseAbs().maxCoeff();
}

/// |x.Ky - y.Kx| / |x.Kx|^(1/2) |y.Ky|^(1/2), K the stiffness of the free degrees of freedom.
double asymmetry(const Formulation& a) {
  const State x = vp::random_state(a, 32), y = vp::random_state(a, 33);
  const Forces Kx = vp::folded_force(a, x), Ky = vp::folded_force(a, y);
  const double xx = std::abs(x.cwiseProduct(Kx).sum()), yy = std::abs(y.cwiseProduct(Ky).sum());
  REQUIRE(xx > 1);
  return std::abs(x.cwiseProduct(Ky).sum() - y.cwiseProduct(Kx).sum()) / std::sqrt(xx * yy);
}

void check(const cases::Case& c) {
  const auto a = vp::assembled(c);
  CHECK(force_error(*a) < 1e-11);  // measured: at most 3.5e-15; wider: the rounding of a sum of energies
  CHECK(asymmetry(*a) < 1e-12);    // measured: at most 8e-17
}

}  // namespace

TEST_CASE("force and energy: free plates with cracks and a hole, every surface correction") {
  for (const auto correction : vp::surface_corrections)
    for (const auto match : {TwistMatch::frame_invariant, TwistMatch::paper}) {
      auto c = vp::cracked_with_hole();
      c.discretization.surface_correction = correction;
      c.discretization.twist_match = match;
      CAPTURE(int(correction), int(match));
      check(c);
    }
}

TEST_CASE("force and energy: every other setting of the discretisation") {
  for (const auto volume : {VolumeCorrection::none, VolumeCorrection::linear, VolumeCorrection::lattice_fitted})
    for (const auto kind : {Influence::inverse, Influence::constant})
      for (const auto full : {FullHorizon::continuum, FullHorizon::lattice}) {
        auto c = vp::cracked_with_hole();
        c.discretization.volume_correction = volume;
        c.discretization.influence = kind;
        c.discretization.full_horizon = full;
        c.discretization.surface_correction = SurfaceCorrection::volume;
        c.discretization.horizon_ratio = 2.3;
        CAPTURE(int(volume), int(kind), int(full));
        check(c);
      }
}

TEST_CASE("force and energy: every support, two at a corner, a crack that runs into one") {
  for (const auto kind :
       {SupportKind::clamped, SupportKind::simply_supported, SupportKind::simply_supported_hard, SupportKind::symmetry,
        SupportKind::clamped_layer, SupportKind::simply_supported_layer, SupportKind::simply_supported_hard_layer})
    for (const auto correction : vp::surface_corrections) {
      auto c = vp::cracked_with_hole();
      c.supports = {vp::held(kind, {"left", "bottom"})};
      c.cracks.push_back({{0, 0.35}, {0.2, 0.55}});  // from the left edge
      c.discretization.surface_correction = correction;
      CAPTURE(int(kind), int(correction));
      check(c);
    }
}

TEST_CASE("force and energy: different supports at the corners, pins") {
  auto c = vp::cracked_with_hole();
  c.supports = {vp::held(SupportKind::clamped, {"left"}), vp::held(SupportKind::symmetry, {"bottom"}),
                vp::held(SupportKind::simply_supported_hard, {"right"}),
                vp::held(SupportKind::simply_supported, {"top"})};
  check(c);
  c.supports = {vp::held(SupportKind::clamped_layer, {"left"}),
                vp::held(SupportKind::symmetry, {"bottom"}),
                {SupportKind::pinned, {}, {{1.15, 0.95}, {0.55, 0.95}}}};
  check(c);
}

TEST_CASE("force and energy: edges oblique to the lattice, a held hole, edges between cell boundaries") {
  for (const auto kind : {SupportKind::clamped, SupportKind::simply_supported}) {
    auto c = vp::cracked_with_hole();
    c.outline.outer = {{{0, 0}, {1.2, 0.13}, {1.03, 1.0}, {0.07, 0.85}}, {"south", "east", "north", "west"}};
    c.supports = {vp::held(kind, {"west", "south", "hole0"})};
    CAPTURE(int(kind));
    check(c);
  }
  auto c = vp::cracked_with_hole();
  c.outline.outer = geometry::rectangle(0, 0, 1.234, 1.047).outer;
  c.supports = {vp::held(SupportKind::clamped, {"right"}), vp::held(SupportKind::simply_supported_hard, {"top"})};
  check(c);
}

TEST_CASE("force and energy: an L-shape held at its re-entrant corner") {
  for (const auto kind : {SupportKind::clamped, SupportKind::simply_supported_hard, SupportKind::clamped_layer}) {
    auto c = vp::cracked_with_hole();
    c.outline.holes.clear();
    c.outline.outer = {{{0, 0}, {1.2, 0}, {1.2, 0.5}, {0.6, 0.5}, {0.6, 1.0}, {0, 1.0}},
                       {"bottom", "right", "step", "wall", "top", "left"}};
    c.supports = {vp::held(kind, {"step", "wall"})};
    CAPTURE(int(kind));
    check(c);
  }
}
