// Supports that only push, in both formulations: squares whose corners lift off, beams and pins whose reactions follow
// from statics, plates that fly off, and plates of which the free part is known.
#include <Eigen/LU>
#include <cmath>
#include <map>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/formulations.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

namespace {

Support pushing(Support support, Push push = Push::up) {
  support.push = push;
  return support;
}

Support simply(std::vector<std::string> edges) {
  return vp::held(SupportKind::simply_supported, std::move(edges));
}

Support pins(std::vector<Point> points) {
  return {SupportKind::pinned, {}, std::move(points)};
}

Load force(double value, const Point& at) {
  return {PointForce{.position = at, .value = value}};
}

cases::Case plate_of(const FormulationKind* kind, const geometry::Outline& outline, double spacing) {
  auto c = vp::free_plate(outline, spacing);
  c.discretization.formulation = kind;
  c.section = vp::section;
  c.loads = {Load{Pressure{.value = -1}}};
  return c;
}

struct Found {
  std::unique_ptr<Formulation> plate;
  State state;
  LiftedSupports lifted;
  std::vector<double> reactions;  // of every holder, along w

  double at(const Point& x) const {
    double sum = 0;
    for (const auto& share : plate->interpolation(x)) sum += share.weight * state(0, share.point);
    return sum;
  }
};

/// Proves that no point of a support that only pushes pulls or overlaps, or is pushed over a gap. `whole`: internal
/// forces and loads. `apart`: the state less settlements.
void prove(const Formulation& plate, const Forces& whole, double forces, const State& apart) {
  State imposed = apart;
  plate.constraints().impose(imposed);
  std::map<std::uint32_t, Push> rows;  // points that no support holds both ways
  for (const auto& [point, holder, rotations] : plate.boundary().holds) {
    if (rotations) continue;
    const auto push = plate.boundary().holders[holder].push;
    if (const auto known = rows.try_emplace(point, push).first; known->second != push) known->second = Push::both_ways;
  }
  std::erase_if(rows, [](const auto& row) { return row.second == Push::both_ways; });
  if (rows.empty()) return;
  Eigen::VectorXd offsets(Eigen::Index(rows.size())), pushed = Eigen::VectorXd::Zero(offsets.size());
  Eigen::MatrixXd by_gaps = Eigen::MatrixXd::Identity(offsets.size(), offsets.size());
  Eigen::Index n = 0;
  for (const auto& [point, push] : rows) {
    const double direction = int(push);
    State moved = zero_like(apart);
    for (const auto& [dof, value] : plate.constraints().lifted(SupportOffsets::gap(point))) {
      pushed[n] -= direction * value * at_dof(whole, dof);
      at_dof(moved, dof) = direction * value;
    }
    Eigen::Index other = 0;
    for (const auto& row : rows) by_gaps(other++, n) = moved(0, row.first);
    offsets[n++] = apart(0, point) - imposed(0, point);
  }
  const Eigen::VectorXd gaps = by_gaps.partialPivLu().solve(offsets);
  const double least_force = pushed.minCoeff(), least_gap = gaps.minCoeff();
  const double product = pushed.cwiseProduct(gaps).cwiseAbs().maxCoeff();
  const double size = apart.row(0).cwiseAbs().maxCoeff();
  CAPTURE(plate.kind().name, least_force / forces, least_gap / size, product / forces / size);
  CHECK(least_force >= -1e-9 * forces);
  CHECK(least_gap >= -1e-9 * size);
  CHECK(product <= 1e-9 * forces * size);
}

/// Solves to rounding, with the proof of what touches.
Found solved(const cases::Case& c) {
  Found result{vp::assembled(c), {}, {}, {}};
  const auto& plate = *result.plate;
  const auto load = plate.total_load();
  const auto lift = total_lift(plate);
  const auto found =
      solve_static(plate, load, StaticMethod::direct, Preconditioning::automatic, {1e-11, 200000, {}}, lift);
  REQUIRE(found.solution.converged);
  result.state = found.solution.state, result.lifted = found.lifted.value_or(LiftedSupports{});
  Forces internal;
  plate.internal_force(result.state, internal);
  const post::Supports supports(plate.boundary());
  for (const auto& one :
       supports.balance(plate.constraints().on_held(internal), supports.applied(load), nullptr, result.state).supports)
    result.reactions.push_back(one.force);
  prove(plate, internal + load, load.row(0).cwiseAbs().sum(),
        lift.cols() > 0 ? State(result.state - lift) : result.state);
  const double work =
      load.cwiseProduct(result.state).sum() / 2 + PrescribedDisplacements(plate, load, lift).work(result.state);
  CHECK(plate.strain_energy(result.state) == Approx(work).epsilon(1e-6));
  return result;
}

const geometry::Outline unit = geometry::rectangle(0, 0, 1, 1);

}  // namespace

TEST_CASE("corners of a square under pressure lift off supports that only push", "[push]") {
  // spectral elements of degree 6 by hand, h / a = 0.1, soft supports: w in the middle, gap at corners [q a^4 / D]
  constexpr double middle = 0.0048051, corner = 0.000662;
  const double D = vp::section.bending_stiffness();
  for (const auto* kind : formulations()) {
    auto c = plate_of(kind, unit, 0.05);
    c.supports = {pushing(simply({"left", "right", "bottom", "top"}))};
    const auto whole = solved(c);
    CAPTURE(kind->name, whole.at({0.5, 0.5}) * D, whole.lifted.largest_gap * D, whole.lifted.share);
    CHECK(whole.at({0.5, 0.5}) * D == Approx(-middle).epsilon(kind == &ordinary ? 0.03 : 0.001));
    CHECK(whole.lifted.largest_gap * D == Approx(corner).epsilon(kind == &ordinary ? 0.2 : 0.06));
    CHECK(whole.lifted.share == Approx(0.37).margin(kind == &ordinary ? 0.12 : 0.03));
    for (const double one : whole.reactions) CHECK(one == Approx(0.25).epsilon(1e-7));
    // a quarter beside mirrors
    c.outline = geometry::rectangle(0.5, 0, 1, 0.5);
    c.supports = {pushing(simply({"right", "bottom"})), vp::held(SupportKind::symmetry, {"left", "top"})};
    const auto quarter = solved(c);
    const double same = kind == &ordinary ? 1e-6 : 1e-3;  // other triangles
    CHECK(quarter.lifted.largest_gap == Approx(whole.lifted.largest_gap).epsilon(same));
    CHECK(quarter.at({0.62, 0.31}) == Approx(whole.at({0.62, 0.31})).epsilon(same));
  }
}

TEST_CASE("a plate that turns, or is turned upside down, lifts off as it did", "[push]") {
  for (const auto* kind : formulations()) {
    auto c = plate_of(kind, geometry::rectangle(0, 0, 1.2, 0.8), 0.05);
    c.loads.push_back(force(-2, {0.33, 0.21}));
    c.supports = {pushing(simply({"left", "bottom"})), pushing(pins({{1.125, 0.725}, {0.725, 0.725}}))};
    const auto first = solved(c);
    CAPTURE(kind->name, first.lifted.share, first.lifted.largest_gap);
    CHECK(first.lifted.share > 0.05);
    auto turned = c;  // by a quarter turn: (x, y) becomes (0.8 - y, x)
    turned.outline = geometry::rectangle(0, 0, 0.8, 1.2);
    turned.loads.back() = force(-2, {0.59, 0.33});
    turned.supports = {pushing(simply({"bottom", "right"})), pushing(pins({{0.075, 1.125}, {0.075, 0.725}}))};
    const auto second = solved(turned);
    const double same = kind == &ordinary ? 1e-6 : 1e-2;  // other triangles
    // of bonds the gap at a corner is that of one edge
    CHECK(second.lifted.largest_gap == Approx(first.lifted.largest_gap).epsilon(0.02));
    CHECK(second.at({0.45, 0.66}) == Approx(first.at({0.66, 0.35})).epsilon(same));
    for (auto& load : c.loads) scale(load, -3);
    for (auto& support : c.supports) support.push = Push::down;
    const auto below = solved(c);
    CHECK((below.state + 3 * first.state).cwiseAbs().maxCoeff() < 1e-7 * below.state.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("an oblique square in the Galerkin plate lifts off as the upright one", "[push]") {
  const auto run = [](double angle) {
    const Eigen::Rotation2Dd turn(angle);
    geometry::Outline outline;
    for (const auto& x : {Point(0, 0), Point(1, 0), Point(1, 1), Point(0, 1)})
      outline.outer.vertices.push_back(turn * x);
    outline.outer.edge_names = {"a", "b", "c", "d"};
    auto c = plate_of(&galerkin, outline, 0.05);
    c.supports = {pushing(simply({"a", "b", "c", "d"}))};
    const auto found = solved(c);
    return std::array{found.at(turn * Point(0.5, 0.5)), found.lifted.largest_gap};
  };
  const auto upright = run(0);
  for (const double angle : {0.3, 0.61, 0.785}) {
    const auto oblique = run(angle);
    CAPTURE(angle, upright, oblique);
    CHECK(oblique[0] == Approx(upright[0]).epsilon(0.01));
    CHECK(oblique[1] == Approx(upright[1]).epsilon(0.1));
  }
}

TEST_CASE("a beam on three lines lifts off the last where statics says so", "[push]") {
  // spans of 1 with P in the middle of the first and p = 1 all over: where P > 4 the last line would pull, and the end
  // stands up by P / 16 D + (1 / 24 - 1 / 6 - 1 / 8) / D - 1 / S
  auto c = plate_of(nullptr, geometry::rectangle(0, 0, 2, 0.2), 0.05);
  c.section.poisson = 0, c.section.thickness = 0.05;
  const double D = c.section.bending_stiffness(), S = c.section.shear_stiffness();
  for (const auto* kind : formulations())
    for (const double P : {0.0, 3.5, 4.5, 8.0, 40.0}) {
      c.discretization.formulation = kind;
      c.supports = {pushing(simply({"left", "right"})),
                    {.kind = SupportKind::pinned, .edges = {}, .points = {}, .along = {{1, 0}, {1, 0.2}}}};
      c.loads = {Load{Pressure{.value = -1}}, Load{LineLoad{.along = {{0.5, 0}, {0.5, 0.2}}, .value = -P}}};
      const auto found = solved(c);
      CAPTURE(kind->name, P, found.lifted.share, found.lifted.largest_gap * D, found.reactions);
      CHECK((found.lifted.largest_gap > 0) == (P > 4));
      if (P < 4) {
        c.supports[0] = simply({"left", "right"});
        CHECK((solved(c).state - found.state).cwiseAbs().maxCoeff() < 1e-8 * found.state.cwiseAbs().maxCoeff());
        continue;
      }
      CHECK(found.lifted.share == 0.5);
      CHECK(found.reactions[0] == Approx(0.2 * P / 2).epsilon(1e-6));  // moments about the middle line
      CHECK(found.reactions[1] == Approx(0).margin(1e-7));
      CHECK(found.lifted.largest_gap * D == Approx((P - 4) / 16 - D / S).margin(0.02 * P / 16));
    }
}

TEST_CASE("pins that only push carry what statics leaves them", "[push]") {
  for (const auto* kind : formulations())
    for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {0.013, 0.027}, {0.04, -0.02}}) {
      auto c = plate_of(kind, unit, 0.05);
      const Point shift(dx, dy);
      const std::vector<Point> places{Point(0.2, 0.2) + shift, Point(0.8, 0.2) + shift, Point(0.2, 0.8) + shift,
                                      Point(0.8, 0.8) + shift};
      c.loads = {force(-6, Point(0.35, 0.3) + shift), force(0.5, Point(0.8, 0.75) + shift)};
      c.supports = {pushing(pins(places))};
      const auto found = solved(c);
      CAPTURE(kind->name, dx, dy, found.reactions, found.lifted.largest_gap);
      CHECK(found.lifted.share == 0.25);
      for (const auto& [i, exact] : {std::pair(0, 3.5 + 5.5 / 12), {1, 1.0}, {2, 1 - 5.5 / 12}, {3, 0.0}})
        CHECK(found.reactions[std::size_t(i)] == Approx(exact).margin(1e-6));
      // a lever: the first pair holds it down behind the second pair
      c.supports = {pushing(pins({places[0], places[2]}), Push::down), pushing(pins({places[1], places[3]}))};
      c.loads = {force(-6, Point(0.92, 0.5) + shift)};
      const auto lever = solved(c);
      CHECK(lever.lifted.share == 0);
      CHECK(lever.reactions[0] + lever.reactions[1] == Approx(-1.2).epsilon(1e-6));
      CHECK(lever.reactions[2] + lever.reactions[3] == Approx(7.2).epsilon(1e-6));
    }
}

TEST_CASE("plates that fly off or tip over supports that only push have no equilibrium", "[push]") {
  for (const auto* kind : formulations()) {
    const auto refused = [&](std::vector<Support> supports, std::vector<Load> loads) {
      auto c = plate_of(kind, unit, 0.1);
      c.supports = std::move(supports), c.loads = std::move(loads);
      const auto plate = vp::assembled(c);
      CAPTURE(kind->name);
      CHECK_THROWS_AS(solve_static(*plate, plate->total_load(), StaticMethod::cg, Preconditioning::automatic, {}),
                      NumericalError);
    };
    const auto all = pushing(simply({"left", "right", "bottom", "top"}));
    refused({all}, {Load{Pressure{.value = 1}}});
    refused({pushing(simply({"left", "right", "bottom", "top"}), Push::down)}, {Load{Pressure{.value = -1}}});
    const auto four = pushing(pins({{0.2, 0.2}, {0.8, 0.2}, {0.2, 0.8}, {0.8, 0.8}}));
    refused({four}, {force(-1, {0.9, 0.5})});
    refused({four}, {force(-1, {0.82, 0.5})});
    refused({pushing(simply({"left"})), pushing(pins({{0.5, 0.5}}))}, {force(-1, {0.6, 0.3})});
  }
}

TEST_CASE("a cracked plate whose edge lifts off has the state of one with a free edge", "[push]") {
  for (const auto* kind : formulations()) {
    auto c = plate_of(kind, unit, 0.05);
    c.cracks = {{{0.4, 0.5}, {0.65, 0.58}}};
    c.loads = {force(1, {0.85, 0.3})};
    const auto clamp = vp::held(SupportKind::clamped, {"left"});
    c.supports = {clamp, pushing(simply({"right"}))};
    const auto lifts = solved(c);
    CHECK(lifts.lifted.share == Approx(1));
    c.supports = {clamp};
    const auto by_hand = solved(c);
    CAPTURE(kind->name, lifts.lifted.largest_gap);
    const auto shared = Eigen::Index(by_hand.plate->cloud().plate_points);
    CHECK((lifts.state - by_hand.state).leftCols(shared).cwiseAbs().maxCoeff() <
          1e-7 * by_hand.state.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a cracked square off its corners has the state of one held where it touches", "[push]") {
  auto c = plate_of(&galerkin, unit, 0.05);
  c.cracks = {{{0.3, 0.62}, {0.55, 0.74}}};
  c.supports = {pushing(simply({"left", "right", "bottom", "top"}))};
  const auto lifts = solved(c);
  const auto& boundary = lifts.plate->boundary();
  std::vector<Point> touching;
  std::vector<std::uint32_t> known;
  for (const auto& [point, holder, rotations] : boundary.holds)
    if (!rotations && std::ranges::find(known, point) == known.end() && lifts.state(0, point) == 0)
      known.push_back(point), touching.push_back(lifts.plate->cloud().positions[point]);
  CHECK(touching.size() > 20);
  c.supports = {pins(touching)};
  const auto by_hand = solved(c);
  REQUIRE(by_hand.state.cols() == lifts.state.cols());
  CHECK((lifts.state - by_hand.state).cwiseAbs().maxCoeff() < 1e-7 * by_hand.state.cwiseAbs().maxCoeff());
}

TEST_CASE("a support that is lower than the others is touched where the plate comes down to it", "[push]") {
  // a beam on two lines with a third in the middle, lower by d: it carries (5/8) p of the span 2 less 6 D d
  auto c = plate_of(nullptr, geometry::rectangle(0, 0, 2, 0.2), 0.05);
  c.section.poisson = 0, c.section.thickness = 0.05;
  const double D = c.section.bending_stiffness(), sag = 5.0 * 16 / 384 / D;
  for (const auto* kind : formulations())
    for (const double share : {0.3, 0.9, 1.1, 2.0}) {
      c.discretization.formulation = kind;
      c.supports = {simply({"left", "right"}),
                    pushing({.kind = SupportKind::pinned, .edges = {}, .points = {}, .along = {{1, 0}, {1, 0.2}}})};
      c.loads = {Load{Pressure{.value = -1}}, Load{Settlement{.support = 1, .value = -share * sag}}};
      const auto found = solved(c);
      CAPTURE(kind->name, share, found.reactions, found.lifted.largest_gap / sag);
      const double exact = 0.2 * std::max(0.0, 6 * D * sag * (1 - share));
      CHECK(found.reactions[2] == Approx(exact).margin(0.01));
      CHECK(found.lifted.largest_gap == Approx(std::max(0.0, share - 1) * sag).margin(0.02 * sag));
    }
}

TEST_CASE("a heated plate stands up from the pin between two others", "[push]") {
  // a plate that is hotter above bends up without stress, kappa = alpha dT / h, and stands on its four corners'
  // supports
  for (const auto* kind : formulations()) {
    auto c = plate_of(kind, unit, 0.05);
    c.section.thermal_expansion = 1e-3;
    c.loads = {Load{Temperature{.value = 10}}, force(-1e-5, {0.5, 0.5})};
    c.supports = {pushing(pins({{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}, {0.5, 0.1}}))};
    const auto found = solved(c);
    CAPTURE(kind->name, found.lifted.share, found.lifted.largest_gap);
    CHECK(found.lifted.share == Approx(0.2));
    CHECK(found.lifted.largest_gap == Approx(1e-3 * 10 / 0.1 / 2 * 0.4 * 0.4).epsilon(1e-3));
  }
}
