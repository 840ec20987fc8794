// Reactions along edges against the series of Kirchhoff's plate, and against equilibrium where that is all there is.
#include <cmath>
#include <numbers>

#include "plate/formulations.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using plate::SupportKind;
namespace vp = verified_plate;

namespace {

/// Levy's series of a simply supported square of side 1 under the pressure 1: the reaction per length at s from a
/// corner (S. P. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells).
double levy_reaction(double s, double poisson) {
  double sum = 0;
  for (int m = 1; m < 400; m += 2) {
    const double k = m * std::numbers::pi, t = std::tanh(k / 2), a = 4 / std::pow(k, 5), b = -(k / 2 * t + 2) / 2;
    const double first = k * (b * t + (t + k / 2) / 2), third = k * k * k * (b * t + (3 * t + k / 2) / 2);
    sum -= a * (third - (2 - poisson) * k * k * first) * std::sin(k * s);
  }
  return sum;
}

constexpr double corner_of_series = 0.06496;  // of the same, for nu = 0.3: of pressure and area

cases::Case loaded(const geometry::Outline& outline, double thickness, double spacing) {
  auto c = vp::free_plate(outline, spacing);
  c.section = {1000, 0.3, thickness};
  c.loads = {{plate::Pressure{.value = 1}}};
  return c;
}

post::EdgeReactions along_edges(const cases::Case& c, std::size_t pieces) {
  const auto plate = vp::assembled(c);
  const auto state = vp::solved(*plate, 1e-11).state;
  plate::Forces internal;
  plate->internal_force(state, internal);
  const post::Supports supports(plate->boundary());
  const auto reaction =
      supports.reaction(plate->constraints().on_held(internal), supports.applied(plate->total_load()), nullptr);
  return supports.along_edges(reaction, pieces, 5 * plate->section().layer());
}

const plate::FormulationKind* galerkin() {
  return *std::ranges::find_if(plate::formulations(), [](const auto* kind) { return kind->name == "galerkin"; });
}

const post::EdgeCurve& edge(const post::EdgeReactions& found, const std::string& name) {
  return *std::ranges::find(found.curves, name, &post::EdgeCurve::edge);
}

geometry::Outline unit_square() {
  return geometry::rectangle(0, 0, 1, 1);
}

}  // namespace

TEST_CASE("hard simple supports have the reactions of the series along every edge, and its force at every corner") {
  for (const auto* kind : plate::formulations())
    for (const double thickness : {0.01, 0.05}) {
      auto c = loaded(unit_square(), thickness, 0.025);
      c.discretization.formulation = kind;
      c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
      const auto found = along_edges(c, 20);
      CAPTURE(kind->name, thickness);
      REQUIRE(found.curves.size() == 4);
      for (const auto& curve : found.curves)
        for (const auto& one : curve.values)
          if (std::min(one.s, 1 - one.s) > 0.15)
            CHECK(one.kirchhoff_force == Approx(levy_reaction(one.s, 0.3)).epsilon(0.01));  // measured: 0.5 %
      REQUIRE(found.corners.size() == 4);
      for (const auto& corner : found.corners)
        CHECK(corner.force == Approx(corner_of_series).epsilon(0.06));  // measured: 4 % with bonds, 0.2 %
    }
}

TEST_CASE("soft simple supports have the reactions of the series away from corners, and no twist") {
  for (const auto* kind : plate::formulations()) {
    auto c = loaded(unit_square(), 0.05, 0.025);
    c.discretization.formulation = kind;
    c.supports = {vp::held_all_round(SupportKind::simply_supported)};
    const auto found = along_edges(c, 20);
    CAPTURE(kind->name);
    for (const auto& curve : found.curves)
      for (const auto& one : curve.values)
        if (std::min(one.s, 1 - one.s) > 0.2) {
          CHECK(one.kirchhoff_force == Approx(levy_reaction(one.s, 0.3)).epsilon(0.015));  // measured: 1.0 %
          CHECK(std::abs(one.twist) < 2e-4);  // of 0.03 at the corners of hard supports
        }
    for (const auto& corner : found.corners)
      CHECK(corner.force == Approx(corner_of_series).epsilon(0.12));  // measured: 10 %: the support is not thin
  }
}

TEST_CASE("a clamped square has the moment and the force of the series in the middle of its edges, no corner forces") {
  for (const auto* kind : plate::formulations()) {
    auto c = loaded(unit_square(), 0.01, 0.025);
    c.discretization.formulation = kind;
    c.supports = {vp::held_all_round(SupportKind::clamped)};
    const auto found = along_edges(c, 21);
    CAPTURE(kind->name);
    CHECK(found.corners.empty());
    REQUIRE(found.curves.size() == 4);
    for (const auto& curve : found.curves) {
      const auto& middle = curve.values[10];
      CHECK(middle.moment == Approx(-0.05133).epsilon(0.02));         // measured: 1.6 % with bonds, 0.6 %
      CHECK(middle.kirchhoff_force == Approx(-0.441).epsilon(0.01));  // by Ritz; measured: 0.4 %
    }
  }
}

TEST_CASE("a cantilever strip that cannot contract is carried alike along its clamp") {
  constexpr double length = 2, pressure = 1;
  auto c = loaded(geometry::rectangle(0, 0, length, 1), 0.05, 0.05);
  c.section.poisson = 0;
  c.supports = {vp::held(SupportKind::clamped, {"left"})};
  for (const auto* kind : plate::formulations()) {
    c.discretization.formulation = kind;
    const auto found = along_edges(c, 10);
    CAPTURE(kind->name);
    REQUIRE(found.curves.size() == 1);
    double force = 0, moment = 0;
    for (const auto& one : found.curves[0].values) force += one.force * one.length, moment += one.moment * one.length;
    CHECK(force == Approx(-pressure * length).epsilon(1e-8));
    CHECK(moment == Approx(-pressure * length * length / 2).epsilon(1e-8));
    for (const auto& one : found.curves[0].values)
      if (std::min(one.s, 1 - one.s) > 0.4) {  // measured with bonds: 2.6 %, 0.3 %
        CHECK(one.force == Approx(-pressure * length).epsilon(0.05));
        CHECK(one.moment == Approx(-pressure * length * length / 2).epsilon(0.01));
      }
  }
}

TEST_CASE("edges of a plate that lies askew to the points have the reactions of one along them") {
  const double cosine = std::cos(std::numbers::pi / 6), sine = 0.5;
  geometry::Outline askew = unit_square();
  for (auto& x : askew.outer.vertices) x = {cosine * x.x() - sine * x.y(), sine * x.x() + cosine * x.y()};
  for (const auto kind : {SupportKind::simply_supported_hard, SupportKind::clamped}) {
    auto c = loaded(unit_square(), 0.05, 0.025), turned = loaded(askew, 0.05, 0.025);
    for (auto* one : {&c, &turned}) {
      one->discretization.formulation = galerkin();
      one->supports = {vp::held_all_round(kind)};
    }
    const auto along = along_edges(c, 10), across = along_edges(turned, 10);
    CAPTURE(int(kind));
    REQUIRE(across.curves.size() == along.curves.size());
    for (const auto& curve : across.curves)
      for (std::size_t i = 2; i < 8; ++i) {
        const auto& expected = edge(along, curve.edge).values[i];
        CHECK(curve.values[i].kirchhoff_force == Approx(expected.kirchhoff_force).epsilon(0.01));  // measured: 0.4 %
        CHECK(curve.values[i].moment == Approx(expected.moment).epsilon(0.01).margin(1e-7));       // measured: 0.3 %
        CHECK(std::abs(curve.values[i].twist - expected.twist) < 3e-4);                            // measured: 8e-5
      }
    REQUIRE(across.corners.size() == along.corners.size());
    for (const auto& corner : across.corners)
      CHECK(corner.force == Approx(along.corners.front().force).epsilon(0.03));  // measured: 1.5 %
  }
}
