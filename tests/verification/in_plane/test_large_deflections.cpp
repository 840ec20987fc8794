// Plates whose middle plane stretches with their deflections. References by own independent programs of the same
// theory: squares by Ritz's method with Legendre polynomials (Levy's case also by his double sine series), 6 digits;
// cracked squares by hp finite elements, 4 digits.
#include "plate/solve/large_deflections.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <tuple>

#include "cases/runs/membrane.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "post/factors/plate_factors.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
using geometry::Point;
namespace vp = verified_plate;

namespace {

/// The square of side 2 about the origin, turned [degrees], under p = q E h^4 / a^4.
cases::Case pressed(double q, double h, SupportKind kind, InPlane in_plane, double spacing, double degrees = 0) {
  auto c = vp::square(spacing);
  const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
  for (auto& x : c.outline.outer.vertices) x = turn * x;
  c.section = {1, 0.3, h, 5.0 / 6, 1};
  c.discretization.formulation = &plate::galerkin;
  c.analysis.kind = cases::Analysis::Kind::static_;
  c.supports = {vp::held_all_round(kind)};
  c.supports[0].in_plane = in_plane;
  c.loads = {{Pressure{q * std::pow(h, 4) / 16}}};
  c.stretches = true;
  return c;
}

struct Found {
  Discretised plates;
  LargeDeflections state;

  explicit Found(const cases::Case& c) : plates(discretise(c)) {
    REQUIRE(plates.membrane);
    state = StretchedPlate(*plates.plate, *plates.membrane)
                .equilibrium({plates.plate->total_load(), plates.membrane->total_load()}, {1e-9, {}});
    REQUIRE(state.converged);
  }
  double largest() const { return state.bending.row(0).cwiseAbs().maxCoeff(); }
  double energy() const { return state.bending_energy + state.membrane_energy; }
};

/// A strip of length 1 between edges that keep their distance, heated to `heat` times its buckling load and loaded by
/// a pressure as constant loads, and by a pressure that grows; the pressures over D pi^4 h.
struct HeatedStrip {
  static constexpr double h = 0.01, D = h * h * h / 12, S = 5.0 / 6 / 2 * h,
                          N = D * std::numbers::pi * std::numbers::pi,
                          unit = N * std::numbers::pi * std::numbers::pi * h;
  static constexpr double heat = 6, first = 0.3, grows = -6;

  cases::Case content(const FormulationKind& formulation, double spacing) const {
    auto c = vp::square(spacing);
    c.outline = geometry::rectangle(0, 0, 1, 0.2);
    c.section = {1, 0, h, 5.0 / 6, 1};
    c.section.thermal_expansion = 1;
    c.discretization.formulation = &formulation;
    c.analysis.kind = cases::Analysis::Kind::static_;
    c.supports = {vp::held(SupportKind::simply_supported, {"left", "right"})};
    c.supports[0].in_plane = InPlane::normal;
    Temperature hot;
    hot.mean = heat * N / h;
    c.loads = {{hot}, {Pressure{first * unit}}, {Pressure{grows * unit}}};
    c.stretches = true;
    return c;
  }

  struct State {
    double pressure, deflection;
  };
  /// The beam under the tension n by its series of sines, up to the sign of both: the deflection is linear in the
  /// pressure, and its length gives n = h k^2 a^2 / 4 - heat N.
  static State state(double n) {
    double shortened = 0, deflection = 0;
    for (int m = 1; m < 100; m += 2) {
      const double k = m * std::numbers::pi, a = 4 / k / (D * k * k * k * k / (1 + D * k * k / S) + n * k * k);
      shortened += h * k * k * a * a / 4, deflection += m % 4 == 1 ? a : -a;
    }
    const double pressure = std::sqrt((n + heat * N) / shortened);
    return {pressure, pressure * std::abs(deflection)};
  }
  static constexpr double buckling = -N / (1 + N / S);  // tension
  static double limit() {
    double most = 0;
    for (int i = 1; i < 5000; ++i)
      most = std::max(most, state(-heat * N + i / 5000.0 * (buckling + heat * N)).pressure);
    return most;
  }
  /// The pressure on the way from the one deflection to the other, of the sign opposite to the deflection.
  static double against(double deflection) {
    double low = -heat * N, high = buckling;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (state(middle).deflection < std::abs(deflection) ? low : high) = middle;
    }
    return std::copysign(state(low).pressure, -deflection);
  }
};

struct Square {
  SupportKind kind;
  InPlane in_plane;
  double q, deflection;  // in thicknesses, h / a = 0.02
};

}  // namespace

TEST_CASE("large deflections: squares with edges of every kind converge to the second order", "[in_plane]") {
  using enum SupportKind;
  const std::vector<Square> squares{
      {simply_supported, InPlane::normal, 15, 0.4972668}, {simply_supported, InPlane::normal, 250, 1.779531},
      {simply_supported, InPlane::fixed, 250, 1.778002},  {simply_supported, InPlane::free, 250, 3.803937},
      {clamped, InPlane::fixed, 250, 1.520717},           {clamped, InPlane::free, 250, 2.131485}};
  for (const auto& one : squares) {
    INFO("kind " << int(one.kind) << ", in the plane " << int(one.in_plane) << ", q " << one.q);
    std::array<double, 2> errors{};
    for (std::size_t i = 0; i < 2; ++i) {
      const Found found(pressed(one.q, 0.04, one.kind, one.in_plane, i == 0 ? 0.1 : 0.05));
      errors[i] = found.largest() / 0.04 / one.deflection - 1;
      CHECK(std::abs(found.state.external_work / found.energy() - 1) < 0.01);
      CHECK(found.state.steps.back().stable);
      CHECK_FALSE(found.state.snapped());
    }
    CAPTURE(errors[0], errors[1]);
    CHECK(std::abs(errors[0]) < 0.03);
    CHECK(std::abs(errors[1]) < 0.008);
    if (std::abs(errors[0]) > 0.005) CHECK(std::log2(errors[0] / errors[1]) > 1.3);  // the order of convergence
  }
  const Found fine(pressed(250, 0.04, clamped, InPlane::fixed, 0.025));
  CHECK(fine.largest() / 0.04 / 1.520717 == Approx(1).epsilon(0.002));
}

TEST_CASE("large deflections: round plates follow the equations of one radius", "[in_plane]") {
  using enum SupportKind;
  // own collocation of the axisymmetric equations with shear, 6 digits (clamped, 1 thickness: Way's problem of 1934);
  // q = p a^4 / (E h^4), h / a = 0.02, nu = 0.3
  const std::vector<Square> plates{{clamped, InPlane::fixed, 9.132583, 1},
                                   {clamped, InPlane::fixed, 255.7923, 4},
                                   {simply_supported, InPlane::fixed, 150, 3.486436},
                                   {simply_supported, InPlane::free, 30, 3.926193}};
  constexpr int sides = 128;
  constexpr double h = 0.02, turn = 2 * std::numbers::pi / sides;
  const double radius = std::sqrt(turn / std::sin(turn));  // of corners, with the area of the circle of radius 1
  auto c = pressed(1, h, clamped, InPlane::fixed, 0.035);
  auto& [vertices, edges] = c.outline.outer;
  vertices.clear(), edges.clear();
  for (int i = 0; i < sides; ++i) {
    vertices.push_back(radius * Point(std::cos(i * turn), std::sin(i * turn)));
    edges.push_back("edge" + std::to_string(i));
  }
  for (const auto& one : plates) {
    INFO("kind " << int(one.kind) << ", in the plane " << int(one.in_plane) << ", q " << one.q);
    c.supports = {vp::held(one.kind, edges)};
    c.supports[0].in_plane = one.in_plane;
    c.loads = {{Pressure{one.q * std::pow(h, 4)}}};
    CHECK(std::abs(Found(c).largest() / h / one.deflection - 1) < 0.005);
  }
}

TEST_CASE("large deflections: glass panes deflect as the standard says", "[in_plane]") {
  // ASTM E1300, appendix on deflections: edges that may slip, E = 71.7 GPa, nu = 0.22; a polynomial through finite
  // differences
  const auto of_standard = [](double a, double b, double h, double pressure) {
    const double s = a / b, x = std::log(std::log(pressure * a * a * b * b / (71.7e9 * std::pow(h, 4))));
    const double r0 = 0.553 - 3.83 * s + 1.11 * s * s - 0.0969 * s * s * s,
                 r1 = -2.29 + 5.83 * s - 2.17 * s * s + 0.2067 * s * s * s,
                 r2 = 1.485 - 1.908 * s + 0.815 * s * s - 0.0822 * s * s * s;
    return h * std::exp(r0 + r1 * x + r2 * x * x);
  };
  for (const double a : {1.2, 1.5})
    for (const double pressure : {1000.0, 2500.0, 6000.0}) {
      constexpr double h = 0.0056;
      const double b = a > 1.3 ? 1 : 1.2;
      auto c = pressed(1, h, SupportKind::simply_supported, InPlane::free, b / 30);
      c.outline = geometry::rectangle(0, 0, a, b);
      c.section = {71.7e9, 0.22, h, 5.0 / 6, 1};
      c.supports = {vp::held(SupportKind::simply_supported, {"left", "right", "bottom", "top"})};
      c.loads = {{Pressure{pressure}}};
      const double w = Found(c).largest();
      INFO(a << " x " << b << ", " << pressure << ": " << w << ", standard " << of_standard(a, b, h, pressure));
      CHECK(std::abs(w / of_standard(a, b, h, pressure) - 1) < 0.015);  // -1.03 to 1.08 %
    }
}

TEST_CASE("large deflections: bonds come to the same squares", "[in_plane]") {
  using enum SupportKind;
  // errors with 20 points a side; with 40: -0.5, +0.15, +0.14, -0.8, -0.1, -1.2 %; of linear theory -6.8 % supported,
  // -16 % clamped, with 40 -1.5, -2.5 %
  const std::vector<std::pair<Square, double>> squares{{{simply_supported, InPlane::normal, 15, 0.4972668}, -0.0249},
                                                       {{simply_supported, InPlane::normal, 250, 1.779531}, 0.0095},
                                                       {{simply_supported, InPlane::fixed, 250, 1.778002}, 0.0089},
                                                       {{simply_supported, InPlane::free, 250, 3.803937}, -0.0369},
                                                       {{clamped, InPlane::fixed, 250, 1.520717}, -0.0184},
                                                       {{clamped, InPlane::free, 250, 2.131485}, -0.0805}};
  for (const auto& [one, error] : squares) {
    INFO("kind " << int(one.kind) << ", in the plane " << int(one.in_plane) << ", q " << one.q);
    auto c = pressed(one.q, 0.04, one.kind, one.in_plane, 0.1);
    c.discretization.formulation = &plate::ordinary;
    const Found found(c);
    CHECK(found.largest() / 0.04 / one.deflection - 1 == Approx(error).margin(0.002));
    CHECK(std::abs(found.state.external_work / found.energy() - 1) < 0.01);  // 0.4 %
    CHECK(found.state.steps.back().stable);
  }
  auto c = pressed(15, 0.04, simply_supported, InPlane::normal, 0.05);
  c.discretization.formulation = &plate::ordinary;
  CHECK(std::abs(Found(c).largest() / 0.04 / 0.4972668 - 1) < 0.01);  // 0.55 %
}

TEST_CASE("large deflections: small loads give linear theory, and the state goes with the plate", "[in_plane]") {
  using enum SupportKind;
  const auto c = pressed(1e-4, 0.04, clamped, InPlane::fixed, 0.1);
  const Found small(c);
  const auto linear = vp::solved(*discretise(c).plate);
  CHECK((small.state.bending - linear.state).norm() < 1e-6 * linear.state.norm());

  const Found straight(pressed(250, 0.04, simply_supported, InPlane::fixed, 0.1));
  const Found up(pressed(-250, 0.04, simply_supported, InPlane::fixed, 0.1));
  CHECK((straight.state.bending + up.state.bending).norm() < 1e-9 * straight.state.bending.norm());
  CHECK((straight.state.membrane - up.state.membrane).norm() < 1e-9 * straight.state.membrane.norm());
  for (const double degrees : {27.0, 45.0}) {
    CAPTURE(degrees);
    const Found turned(pressed(250, 0.04, simply_supported, InPlane::fixed, 0.05, degrees));
    CHECK(std::abs(turned.largest() / 0.04 / 1.778002 - 1) < 0.005);
  }
}

TEST_CASE("large deflections: linear theory is off as estimated, within a factor of 2", "[in_plane]") {
  using enum SupportKind;
  const std::vector<Square> squares{
      {simply_supported, InPlane::normal, 15, 0}, {simply_supported, InPlane::normal, 60, 0},
      {simply_supported, InPlane::fixed, 8, 0},   {simply_supported, InPlane::fixed, 100, 0},
      {simply_supported, InPlane::free, 60, 0},   {simply_supported, InPlane::free, 200, 0},
      {clamped, InPlane::fixed, 60, 0},           {clamped, InPlane::fixed, 250, 0},
      {clamped, InPlane::free, 100, 0},           {clamped, InPlane::free, 250, 0}};
  for (const auto& one : squares)
    for (const bool cracked : {false, true}) {
      INFO("kind " << int(one.kind) << ", in the plane " << int(one.in_plane) << ", q " << one.q << ", " << cracked);
      auto c = pressed(one.q, 0.04, one.kind, one.in_plane, 0.1);
      if (cracked) c.cracks = {{Point(-0.5, 0), Point(0.5, 0)}};
      const Found found(c);
      const auto& plate = *found.plates.plate;
      const State linear = vp::solved(plate).state;
      const double off = linear.row(0).cwiseAbs().maxCoeff() / found.largest() - 1;
      const double estimated = linear_theory_off(plate, *found.plates.membrane, linear, {{}, zero_like(linear)});
      CHECK(off > 0.05);
      CHECK(estimated > off / 2);
      CHECK(estimated < off * 2);
      c.stretches = false;  // the plane that is made when it is needed is the same
      const auto alone = discretise(c);
      CHECK_FALSE(alone.membrane);
      CHECK(linear_theory_off(*alone.plate, *alone.plate->middle_plane(), linear, {{}, zero_like(linear)}) ==
            estimated);
    }
}

TEST_CASE("large deflections: linear theory is off by loads in the plane as estimated", "[in_plane]") {
  const double N = std::numbers::pi * std::numbers::pi * Section{1, 0.3, 0.04, 5.0 / 6, 1}.bending_stiffness() / 4;
  for (const double share : {2.0, 0.5, -0.25}) {  // of the buckling load under all-round compression, over two
    INFO("share " << share);
    auto c = pressed(3, 0.04, SupportKind::simply_supported, InPlane::free, 0.1);
    c.supports.push_back(vp::held(SupportKind::in_plane, {}));
    c.supports.back().points = {{0, 0}, {0.1, 0}};
    EdgeTraction traction{c.supports[0].edges};
    traction.tensor = std::array{share * N, share * N, 0.0};
    c.loads.push_back({traction});
    const Found found(c);
    const auto& plate = *found.plates.plate;
    const State linear = vp::solved(plate).state;
    const double off = linear.row(0).cwiseAbs().maxCoeff() / found.largest() - 1;
    const double estimated =
        linear_theory_off(plate, *found.plates.membrane, linear, {{}, found.plates.membrane->total_load()});
    CHECK(off * share > 0);
    CHECK(estimated / off > 0.5);
    CHECK(estimated / off < 2);
  }
}

TEST_CASE("large deflections: a plate that nothing holds in its plane is pinned without a force", "[in_plane]") {
  const Found found(pressed(60, 0.04, SupportKind::simply_supported, InPlane::free, 0.1));
  const auto& membrane = *found.plates.membrane;
  CHECK_FALSE(membrane.held());
  Forces left;
  membrane.internal_force(found.state.membrane, left);
  left += found.state.stretch.forces;
  CHECK(left.cwiseAbs().maxCoeff() < 1e-8 * found.state.stretch.forces.cwiseAbs().maxCoeff());
}

TEST_CASE("large deflections: factors of a cracked square are within their estimated errors", "[in_plane]") {
  struct Crack {
    double degrees, a, q, K1, N1;  // q = p / (E h^4), K1 over E h^4, N1 over E h^3; half the side is 1
  };
  const std::vector<Crack> cracks{{30, 0.3, 3, 0.07114803, 0.3578126}, {0, 0.5, 20, 0.1211345, 1.75249}};
  for (const auto& [degrees, a, q, K1, N1] : cracks) {
    INFO("a " << a << ", turned by " << degrees);
    const double h = 0.02;
    auto c = pressed(16 * q, h, SupportKind::simply_supported, InPlane::fixed, 0.05, degrees);
    const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
    c.cracks = {{turn * Point(-a, 0), turn * Point(a, 0)}};
    c.discretization.tip_spacing = h / 12, c.discretization.spacing_growth = 0.1;
    c.srif.emplace();
    const Found found(c);
    const auto bending = post::srifs(*found.plates.plate, *c.srif, cases::tip_methods({c, {}}, *found.plates.plate),
                                     found.state.bending);
    const auto methods = cases::tip_methods({c, {}}, *found.plates.membrane);
    const auto in_plane = cases::membrane_results(*found.plates.membrane, found.state.membrane,
                                                  found.plates.membrane->total_load() + found.state.stretch.forces, {},
                                                  {c.srif, methods}, "", &found.state.stretch);
    for (const auto* one : post::recommended(bending)) {
      CHECK(std::abs(one->K1 / (std::pow(h, 4) * K1) - 1) < 0.01);
      CHECK(std::abs(one->K1 - std::pow(h, 4) * K1) < one->errors[0].value());
    }
    for (const auto* one : post::recommended(in_plane.factors)) {
      CHECK(std::abs(one->K1 / (std::pow(h, 3) * N1) - 1) < 0.003);
      CHECK(std::abs(one->K1 - std::pow(h, 3) * N1) < one->errors[0].value());
    }
  }
}

TEST_CASE("large deflections: loads beyond all load steps are told, with their deflection by linear theory",
          "[in_plane]") {
  const auto plates = discretise(pressed(1e9, 0.04, SupportKind::simply_supported, InPlane::fixed, 0.2));
  const auto found = StretchedPlate(*plates.plate, *plates.membrane)
                         .equilibrium({plates.plate->total_load(), plates.membrane->total_load()}, {1e-9, {}});
  CHECK_FALSE(found.converged);
  CHECK_THAT(found.stop_reason,
             Catch::Contains("beyond 0 of the loads") && Catch::Contains("thicknesses in linear theory: reduce them"));
}

TEST_CASE("large deflections: the path by arc length snaps through as the series of a heated strip", "[in_plane]") {
  struct Strip {
    const FormulationKind& formulation;
    double spacing, limit, branch;  // tolerances over the limit pressure
  };
  // limit pressures 0.16 % and 2.84 % off, unstable branches 0.17 % and 1.77 %; 40 points along: 0.09 and 0.85 %
  const std::vector<Strip> strips{{plate::galerkin, 1.0 / 30, 0.003, 0.003}, {plate::ordinary, 1.0 / 24, 0.04, 0.025}};
  const HeatedStrip exact;
  const double limit = exact.limit();
  for (const auto& [formulation, spacing, of_limit, of_branch] : strips) {
    INFO(formulation.name);
    const auto made = discretise(exact.content(formulation, spacing));
    const auto& [plate, membrane] = std::tie(*made.plate, *made.membrane);
    const auto loads_with = [&](const std::vector<double>& shares) {
      PlateLoads loads{zero_forces(plate.points()), zero_forces(plate.points()),
                       stiffness_of_heat(membrane, heat_of(membrane, shares))};
      for (std::size_t i = 0; i < shares.size(); ++i)
        loads.across += shares[i] * plate.loads()[i].forces, loads.in_plane += shares[i] * membrane.loads()[i].forces;
      return loads;
    };
    const auto constant = loads_with({1, 1, 0});
    auto loads = loads_with({0, 0, 1});
    loads.constant = &constant;
    const StretchedPlate both(plate, membrane);
    const auto start = both.equilibrium(constant, {1e-8, {}});
    const auto found = both.equilibrium(loads, {1e-8, {}, LoadControl::arc_length});
    REQUIRE(found.converged);
    const auto pressure = [&](double factor) { return exact.unit * (exact.first + factor * exact.grows); };

    REQUIRE(found.limits.size() == 2);
    CHECK(std::abs(pressure(found.limits[0]) / limit + 1) < of_limit);
    CHECK(std::abs(pressure(found.limits[1]) / limit - 1) < of_limit);
    CHECK(std::abs(pressure(found.limits[0]) + pressure(found.limits[1])) < 3e-4 * limit);  // 6e-5, by symmetry
    std::size_t unstable = 0, modes = 0;
    for (const auto& step : found.steps) {
      CHECK(step.stable == (step.unstable_modes == 0));
      modes = std::max(modes, step.unstable_modes);
      if (step.stable) continue;
      ++unstable;
      CHECK(std::abs(pressure(step.factor) - exact.against(step.deflection)) < of_branch * limit);
    }
    CHECK(unstable >= 4);  // 5
    CHECK(modes == 2);     // the second without symmetry
    CHECK(found.steps.front().factor == 0);
    CHECK(found.steps.back().stable);
    CHECK(found.steps.back().factor == 1);

    const double gained = found.bending_energy + found.membrane_energy - start.bending_energy - start.membrane_energy;
    CHECK(std::abs((found.external_work - start.external_work) / gained - 1) < 0.004);  // 0.09 %, 0.01 %
    CHECK((found.steps.front().deflection > 0 && found.steps.back().deflection < 0));

    const auto jumped = both.equilibrium(loads, {1e-8, {}});
    CHECK(jumped.snapped());
    CHECK((jumped.bending - found.bending).norm() < 1e-5 * found.bending.norm());
  }
}
