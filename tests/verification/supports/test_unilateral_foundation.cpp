// Soil that lets the plate lift off, in both formulations: a beam of Timoshenko whose ends stand up, full contact,
// books at rest and in motion, symmetry.
#include <Eigen/LU>
#include <complex>

#include "plate/formulation/boundary.hpp"
#include "plate/formulations.hpp"
#include "plate/model/errors.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/at_rest.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point, vp::at;

namespace {

cases::Case on_soil(const FormulationKind* kind, const geometry::Outline& outline, double spacing, double modulus) {
  auto c = vp::free_plate(outline, spacing);
  c.discretization.formulation = kind;
  c.section = vp::section;
  c.foundations = {{modulus, 0, {}, true}};
  return c;
}

Load across(double x, double top, double value) {
  return {LineLoad{.along = {{x, 0}, {x, top}}, .value = value}};
}

Load force_at(const Point& x, double value) {
  return {PointForce{.position = x, .value = value}};
}

StaticSolution solved(const Formulation& plate, StaticMethod method = StaticMethod::cg) {
  const auto found = solve_static(plate, plate.total_load(), method, Preconditioning::automatic, {1e-9, 200000, {}},
                                  total_lift(plate));
  REQUIRE(found.solution.converged);
  return found.solution;
}

/// A beam of Timoshenko on Winkler's soil under a force P in its middle, that lifts off at x = c on either side: beyond
/// it is straight and free. w = sum of a_i exp(r_i x) with r^4 - k / S r^2 + k / D = 0 and psi = (r - k / (S r)) w; in
/// the middle psi = 0 and Q = -P / 2, at c no moment and no shear force, and c is where w = 0.
struct Lifting {
  double c = 0, middle = 0, slope = 0;  // slope: of what stands up
};

Lifting lifting(double D, double S, double k, double P) {
  using Complex = std::complex<double>;
  const Complex root = std::sqrt(Complex(k * k / (S * S) - 4 * k / D));
  const Complex one = std::sqrt((k / S + root) / 2.0), other = std::sqrt((k / S - root) / 2.0);
  const std::array<Complex, 4> r{one, -one, other, -other};
  Lifting result;
  const auto solve = [&](double c) {
    Eigen::Matrix4cd rows;
    for (int i = 0; i < 4; ++i) {
      const Complex q = r[std::size_t(i)], psi = q - k / (S * q), e = std::exp(q * c);
      rows.col(i) << psi, S * (q - psi), q * psi * e, (q - psi) * e;
    }
    const Eigen::Vector4cd a = rows.fullPivLu().solve(Eigen::Vector4cd(0, -P / 2, 0, 0));
    Complex w = 0, middle = 0, slope = 0;
    for (int i = 0; i < 4; ++i) {
      const Complex q = r[std::size_t(i)], e = std::exp(q * c);
      w += a[i] * e, middle += a[i], slope += a[i] * (q - k / (S * q)) * e;
    }
    result = {c, middle.real(), slope.real()};
    return w.real();
  };
  const double lambda = std::pow(k / (4 * D), 0.25);
  double low = 0.5 / lambda, high = 2.5 / lambda;
  const double sign = solve(low);
  while (high - low > 1e-12) {
    const double c = (low + high) / 2;
    (solve(c) * sign > 0 ? low : high) = c;
  }
  return result;
}

}  // namespace

TEST_CASE("thin beams touch soil over pi / lambda", "[soil]") {  // Weitsman 1970: the reference itself
  const auto thin = lifting(1, 1e9, 4, -1);
  CHECK(thin.c == Approx(std::numbers::pi / 2).epsilon(1e-4));
  CHECK(thin.middle == Approx(-1.0 / 8 / std::tanh(std::numbers::pi / 2)).epsilon(1e-4));
}

TEST_CASE("a beam whose ends stand up from soil", "[soil]") {
  const double D = vp::section.bending_stiffness(), S = vp::section.shear_stiffness();
  for (const auto* kind : formulations())
    for (const double lambda : {3.0, 4.0, 5.0}) {
      const double k = 4 * D * std::pow(lambda, 4);
      const auto exact = lifting(D, S, k, -1);
      std::vector<std::array<double, 3>> errors;
      for (const double spacing : {0.05, 0.025}) {
        auto c = on_soil(kind, geometry::rectangle(0, 0, 2, 0.2), spacing, k);
        c.supports = {vp::held(SupportKind::symmetry, {"bottom", "top"})};
        c.loads = {across(1, 0.2, -1)};
        const auto plate = vp::assembled(c);
        const auto u = solved(*plate).state;
        const double end = (at(*plate, u, {0.1, 0.1}) - exact.slope * (0.9 - exact.c)) / exact.middle;
        errors.push_back({std::abs(at(*plate, u, {1, 0.1}) / exact.middle - 1),
                          std::abs(plate->boundary().elastic_supports.contact_share(u) - exact.c), std::abs(end)});
        const double work = plate->total_load().cwiseProduct(u).sum() / 2;
        CHECK(plate->strain_energy(u) == Approx(work).epsilon(1e-7));
      }
      CAPTURE(kind->name, lambda, exact.c, errors[0], errors[1]);
      CHECK(errors[1][0] < 0.025);
      CHECK(errors[1][1] < 0.005);
      CHECK(errors[1][0] < errors[0][0] / 1.8);
      CHECK(errors[1][2] < 0.06);
    }
}

TEST_CASE("soil that is pressed everywhere is Winkler's", "[soil]") {
  for (const auto* kind : formulations()) {
    auto c = on_soil(kind, geometry::rectangle(0, 0, 1, 1), 0.05, 0.3);
    c.foundations[0].patch = geometry::Circle{{0.5, 0.5}, 0.33, ""};
    c.loads = {force_at({0.475, 0.475}, -0.02), Load{Pressure{.value = -0.5}}};
    const auto lifts = vp::assembled(c);
    c.foundations[0].unilateral = false;
    const auto holds = vp::assembled(c);
    const auto u = solved(*lifts).state, v = solved(*holds).state;
    CAPTURE(kind->name);
    CHECK(lifts->boundary().elastic_supports.contact_share(u) == 1);
    CHECK((u - v).cwiseAbs().maxCoeff() < 1e-7 * v.cwiseAbs().maxCoeff());
    CHECK(lifts->strain_energy(u) == Approx(holds->strain_energy(v)).epsilon(1e-7));
  }
}

TEST_CASE("a slab that lifts off is symmetric and in balance by every solver and doubles with its load", "[soil]") {
  for (const auto* kind : formulations()) {
    auto c = on_soil(kind, geometry::rectangle(-1, -1, 1, 1), 0.1, 50);
    const Load down{Pressure{.value = -0.5}};
    c.loads = {force_at({0.75, 0.75}, -1), force_at({0, 0}, 0.3), down};
    if (kind->offers(Feature::horizon)) c.loads[1].as<PointForce>()->position = {0.05, 0.05};
    const auto plate = vp::assembled(c);
    const auto u = solved(*plate).state;
    const double size = u.row(0).cwiseAbs().maxCoeff(), touches = plate->boundary().elastic_supports.contact_share(u);
    CAPTURE(kind->name, touches);
    CHECK(touches > 0.1);
    CHECK(touches < 0.95);
    for (const auto& x : {Point(0.3, 0.7), Point(-0.5, 0.2), Point(0.9, -0.9)})
      CHECK(std::abs(at(*plate, u, x) - at(*plate, u, {x.y(), x.x()})) < 1e-6 * size);
    Forces left;
    plate->internal_force(u, left);
    left += plate->total_load();
    CHECK(std::abs(left.row(0).sum()) < 1e-7);
    const auto direct = solved(*plate, StaticMethod::direct).state, adr = solved(*plate, StaticMethod::adr).state;
    CHECK((u - direct).cwiseAbs().maxCoeff() < 1e-5 * size);
    CHECK((u - adr).cwiseAbs().maxCoeff() < 1e-4 * size);
    for (auto& load : c.loads) scale(load, 2);
    const auto twice = vp::assembled(c);
    CHECK((2 * u - solved(*twice).state).cwiseAbs().maxCoeff() < 1e-5 * size);
  }
}

TEST_CASE("a plate that nothing holds down ends with an error", "[soil]") {
  for (const auto* kind : formulations())
    for (const Point& x : {Point(0.475, 0.475), Point(0.975, 0.975)}) {
      auto c = on_soil(kind, geometry::rectangle(0, 0, 1, 1), 0.05, 30);
      c.loads = {force_at(x, 1)};
      const auto plate = vp::assembled(c);
      bool found = false;
      try {
        found =
            solve_static(*plate, plate->total_load(), StaticMethod::cg, Preconditioning::automatic, {1e-6, 2000, {}})
                .solution.converged;
      } catch (const NumericalError&) {
      }
      CHECK(!found);
    }
}

TEST_CASE("in motion a plate leaves its soil and comes back with the energy that it was given", "[soil]") {
  for (const auto* kind : formulations()) {
    auto c = on_soil(kind, geometry::rectangle(0, 0, 1, 1), 0.1, 30);
    const Load weight{Pressure{.value = -0.5}};
    Load pulse{Pressure{.value = 4, .patch = geometry::Circle{{0.3, 0.4}, 0.3, ""}}};
    pulse.history.kind = History::Kind::table, pulse.history.table = {{0, 0}, {0.1, 1}, {0.2, 0}};
    c.loads = {weight, pulse};
    const auto plate = vp::assembled(c);
    std::vector<double> imbalance, least;
    for (const double share : {0.8, 0.4}) {
      DynamicOptions options;
      options.time_step = share * stable_time_step(*plate, 1);
      options.steps = std::size_t(1.5 / options.time_step), options.observe_every = 5;
      options.start =
          solve_static(*plate, plate->first_load(), StaticMethod::cg, Preconditioning::automatic, {1e-10, 20000, {}})
              .solution.state;
      double worst = 0, most = 0, first = 0;
      least.push_back(1);
      central_differences(
          *plate, plate->constraints(), plate->mass(), plate->loads(), options, [&](const Instant& now) {
            const double left = now.strain_energy + now.discrete_kinetic_energy - now.external_work;
            if (now.step == 0) first = left;
            worst = std::max(worst, std::abs(left - first));
            most = std::max(most, now.strain_energy + now.discrete_kinetic_energy);
            least.back() = std::min(least.back(), plate->boundary().elastic_supports.contact_share(now.state));
          });
      imbalance.push_back(worst / most);
    }
    CAPTURE(kind->name, imbalance, least);
    CHECK(least[0] < 0.5);  // it leaves the soil
    CHECK(imbalance[0] < 0.01);
    CHECK(imbalance[1] < imbalance[0] / 2);
  }
}

namespace {

Load settlement(std::size_t support, double value, const Point& slope = {0, 0}) {
  return {Settlement{.support = support, .value = value, .slope = slope}};
}

post::Balance balance(const Formulation& plate, const State& state) {
  const post::Supports supports(plate.boundary());
  Forces internal;
  plate.internal_force(state, internal);
  return supports.balance(plate.constraints().on_held(internal), supports.applied(plate.total_load()), nullptr, state);
}

/// Work of loads and supports that have grown slowly.
double slow_work(const Formulation& plate, const State& state) {
  const auto load = plate.total_load();
  const auto lift = total_lift(plate);
  return load.cwiseProduct(state).sum() / 2 + PrescribedDisplacements(plate, load, lift).work(state);
}

/// Clamped on the left, a pin on the right, weight and soil beneath all of it.
cases::Case pinned_on_soil(const FormulationKind* kind, double pin) {
  auto c = on_soil(kind, geometry::rectangle(0, 0, 2, 1), 0.1, 40);
  c.supports = {vp::held(SupportKind::clamped, {"left"}), {SupportKind::pinned, {}, {{1.65, 0.45}}}};
  c.loads = {settlement(1, pin), Load{Pressure{.value = -0.5}}};
  return c;
}

}  // namespace

TEST_CASE("supports that push the plate into soil find Winkler's, supports that take it off find none", "[soil]") {
  for (const auto* kind : formulations())
    for (const double value : {-0.05, 0.05}) {
      auto c = on_soil(kind, geometry::rectangle(0, 0, 1, 1), 0.1, 40);
      c.supports = {vp::held(SupportKind::clamped, {"left"}), vp::held(SupportKind::simply_supported, {"right"})};
      c.loads = {settlement(0, value), settlement(1, value)};
      const auto lifts = vp::assembled(c);
      const auto u = solved(*lifts).state;
      c.foundations[0].unilateral = false;
      if (value > 0) c.foundations.clear();
      const auto other = vp::assembled(c);
      const auto v = solved(*other).state;
      CAPTURE(kind->name, value);
      CHECK(lifts->boundary().elastic_supports.contact_share(u) == (value > 0 ? 0 : 1));
      CHECK((u - v).cwiseAbs().maxCoeff() < 1e-7 * std::abs(value));
      CHECK(std::abs(lifts->strain_energy(u) - other->strain_energy(v)) < 1e-6 * 40 * value * value / 2);
      if (value < 0) CHECK(slow_work(*lifts, u) == Approx(lifts->strain_energy(u)).epsilon(1e-6));
      CHECK(std::abs(balance(*lifts, u).supports[0].force) < (value > 0 ? 1e-9 : 40.0 * 0.05));
    }
}

TEST_CASE("a pin that takes a plate off its soil in part pulls with the force that would do so", "[soil]") {
  for (const auto* kind : formulations())
    for (const double value : {0.06, -0.06}) {
      auto c = pinned_on_soil(kind, value);
      const auto plate = vp::assembled(c);
      const auto u = solved(*plate).state;
      const double touches = plate->boundary().elastic_supports.contact_share(u), size = u.cwiseAbs().maxCoeff();
      const auto found = balance(*plate, u);
      const double force = found.supports[1].force;
      CAPTURE(kind->name, value, touches, force);
      CHECK(force * value > 0);
      CHECK(touches > 0.05);
      if (value > 0) CHECK(touches < 0.95);
      CHECK(found.residual < 1e-6);
      CHECK(slow_work(*plate, u) == Approx(plate->strain_energy(u)).epsilon(1e-6));
      for (const auto method : {StaticMethod::direct, StaticMethod::adr})
        CHECK((u - solved(*plate, method).state).cwiseAbs().maxCoeff() < 1e-4 * size);
      for (auto& load : c.loads) scale(load, 2);
      CHECK((2 * u - solved(*vp::assembled(c)).state).cwiseAbs().maxCoeff() < 1e-5 * size);
      c = pinned_on_soil(kind, value);
      c.supports.pop_back();
      c.loads[0] = force_at({1.65, 0.45}, force);
      CHECK((u - solved(*vp::assembled(c)).state).cwiseAbs().maxCoeff() < 1e-5 * size);
    }
}

TEST_CASE("a plate that a pin takes off its soil in time keeps the balance of energies, and rests where it rests",
          "[soil]") {
  for (const auto* kind : formulations()) {
    auto c = pinned_on_soil(kind, 0.1);
    const auto resting = vp::assembled(c);
    const auto u = solved(*resting).state;
    const auto run = [](const Formulation& plate, const State& start, const auto& see) {
      DynamicOptions options;
      options.time_step = 0.4 * stable_time_step(plate, 1), options.steps = std::size_t(1.5 / options.time_step);
      options.observe_every = 5, options.start = start, options.unconstrained_mass = driven_mass(plate, 1);
      central_differences(plate, plate.constraints(), plate.mass(), plate.loads(), options, see);
    };
    const double strain = resting->strain_energy(u);
    CAPTURE(kind->name, strain);
    run(*resting, u, [&](const Instant& now) {  // found to 1e-9
      if (now.step % 50 != 0) return;
      CHECK((now.state - u).cwiseAbs().maxCoeff() < 1e-5 * u.cwiseAbs().maxCoeff());
      CHECK(now.external_work == Approx(strain).epsilon(1e-5));
      CHECK(now.kinetic_energy < 1e-8 * strain);
    });
    auto& history = c.loads[0].history;
    history.kind = History::Kind::table;
    for (int i = 0; i <= 100; ++i)
      history.table.emplace_back(0.012 * i, (1 - std::cos(std::numbers::pi * 0.01 * i)) / 2);
    const auto moving = vp::assembled(c);
    double worst = 0, most = 0, least = 1, largest = 0;
    run(*moving, {}, [&](const Instant& now) {
      worst = std::max(worst, std::abs(now.strain_energy + now.discrete_kinetic_energy - now.external_work));
      most = std::max(most, now.strain_energy + now.discrete_kinetic_energy);
      const double touches = moving->boundary().elastic_supports.contact_share(now.state);
      least = std::min(least, touches), largest = std::max(largest, touches);
    });
    CAPTURE(worst / most, least, largest);
    CHECK(least < 0.7);
    CHECK(largest > least + 0.2);
    CHECK(worst < 0.01 * most);
  }
}
