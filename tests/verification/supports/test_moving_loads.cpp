// Loads that move along paths, in both formulations, against the double series of the plate of Mindlin with hard
// supports: every wave has two motions, of bending and of thickness shear.
#include <Eigen/Eigenvalues>

#include "plate/formulation/interpolation.hpp"
#include "plate/formulations.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/statics.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point;

namespace {

constexpr double pi = std::numbers::pi;

/// Deflection at x of a unit square under a force of 1 that moves from `begin` along x with the speed v: of
/// sin(m pi x) sin(n pi y), L = (m^2 + n^2) pi^2, w = W sin sin and psi = B grad(sin sin) have the energies S L (W -
/// B)^2 / 8, D L^2 B^2 / 8, and the masses rho h / 4 and rho h^3 L / 48. `spread`: side of a square about it that the
/// force is spread over.
double series(const Point& x, const Point& begin, double v, double time, double spread = 0) {
  const auto& s = vp::section;
  const double D = s.bending_stiffness(), S = s.shear_stiffness(), h = s.thickness;
  const auto share = [&](int m) {
    const double half = m * pi * spread / 2;
    return spread > 0 ? std::sin(half) / half : 1.0;
  };
  double sum = 0;
  for (int m = 1; m < 40; ++m)
    for (int n = 1; n < 40; ++n) {
      const double L = (m * m + n * n) * pi * pi, omega = m * pi * v;
      Eigen::Matrix2d K;
      K << S * L, -S * L, -S * L, S * L + D * L * L;
      const Eigen::Vector2d mass(s.density * h, s.density * h * h * h / 12 * L);
      const Eigen::Vector2d scale = mass.cwiseSqrt().cwiseInverse();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> modes(scale.asDiagonal() * K * scale.asDiagonal());
      const double force = 4 * std::sin(n * pi * begin.y()) * share(m) * share(n);
      double W = 0;
      for (int i = 0; i < 2; ++i) {
        const double square = modes.eigenvalues()[i], own = std::sqrt(square);
        const double shape = scale[0] * modes.eigenvectors()(0, i);
        W += shape * shape * force / (square - omega * omega) *
             (std::cos(m * pi * begin.x()) * (std::sin(omega * time) - omega / own * std::sin(own * time)) +
              std::sin(m * pi * begin.x()) * (std::cos(omega * time) - std::cos(own * time)));
      }
      sum += W * std::sin(m * pi * x.x()) * std::sin(n * pi * x.y());
    }
  return sum;
}

struct Errors {
  double rms = 0, imbalance = 0;
};

Errors errors(const FormulationKind* kind, double spacing, double speed, const Load& load, double spread) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), spacing);
  c.discretization.formulation = kind;
  c.section = vp::section;
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  c.loads = {load};
  const auto plate = vp::assembled(c);
  const Point x(0.5, 0.5);
  const double length = load.path().back().x() - load.path().front().x();
  const auto shares = plate->interpolation(x);
  DynamicOptions options;
  options.time_step = 0.8 * stable_time_step(*plate, 1);
  options.steps = std::size_t(0.98 * length / speed / options.time_step),
  options.observe_every = std::max<std::size_t>(1, options.steps / 60);
  double squares = 0, largest = 0, count = 0, apart = 0, most = 0, first = 0;
  central_differences(*plate, plate->constraints(), plate->mass(), plate->loads(), options, [&](const Instant& now) {
    double w = 0;
    for (const auto& share : shares) w += share.weight * now.state(0, share.point);
    const double exact = series(x, load.path()[0], speed, now.time, spread);
    squares += (w - exact) * (w - exact), largest = std::max(largest, std::abs(exact)), ++count;
    const double left = now.strain_energy + now.discrete_kinetic_energy - now.external_work;
    if (now.step == 0) first = left;  // a load that sets in at once
    apart = std::max(apart, std::abs(left - first));
    most = std::max(most, now.external_work);
  });
  return {std::sqrt(squares / count) / largest, apart / most};
}

}  // namespace

TEST_CASE("a force that runs across a plate") {
  for (const auto* kind : formulations())
    for (const double speed : {1.0, 3.0, 6.0}) {
      const Load load{PointForce{.value = 1, .path = {{0, 0.3}, {1, 0.3}}, .speed = speed}};
      const auto coarse = errors(kind, 0.1, speed, load, 0), fine = errors(kind, 0.05, speed, load, 0);
      CAPTURE(kind->name, speed, coarse.rms, fine.rms, coarse.imbalance, fine.imbalance);
      CHECK(fine.rms < 0.025);
      CHECK(fine.rms < coarse.rms / 2);
      CHECK(fine.imbalance < 0.01);
    }
}

TEST_CASE("a square of pressure that runs across a plate, along a path of several pieces") {
  for (const auto* kind : formulations()) {
    const Load load{Pressure{.value = 1 / 0.04,
                             .patch = geometry::Polygon{{{0.02, 0.2}, {0.22, 0.2}, {0.22, 0.4}, {0.02, 0.4}}, {}},
                             .path = {{0.12, 0.3}, {0.37, 0.3}, {0.88, 0.3}},
                             .speed = 2}};
    const auto coarse = errors(kind, 0.1, 2, load, 0.2), fine = errors(kind, 0.05, 2, load, 0.2);
    CAPTURE(kind->name, coarse.rms, fine.rms, coarse.imbalance, fine.imbalance);
    CHECK(fine.rms < 0.03);
    CHECK(fine.imbalance < 0.01);
  }
}

namespace {

/// A plate on soil, which a slow wheel crosses.
cases::Case on_soil(const FormulationKind* kind, const Load& wheel) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 0.6), 0.05);
  c.discretization.formulation = kind;
  c.section = vp::section;
  c.foundations = {Foundation{.modulus = 2000, .patch = {}}};
  c.loads = {wheel};
  return c;
}

/// A square of pressure with sides of 2 r and this force.
Load wheel(const Point& begin, const Point& end, double speed, double r = 0.05, double force = 1) {
  return {Pressure{.value = force / (4 * r * r),
                   .patch = geometry::Polygon{{begin + Point(-r, -r), begin + Point(r, -r), begin + Point(r, r),
                                               begin + Point(-r, r)},
                                              {}},
                   .path = {begin, end},
                   .speed = speed}};
}

/// A plate of sea ice on water of 8.25 m by 12.75 m in SI units, with a crack of 4 m from its lower edge and the wheel
/// of a truck of 50 kN.
cases::Case on_ice(const FormulationKind* kind, const Point& begin, const Point& end, double speed) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 12.75, 8.25), 0.75);
  c.discretization.formulation = kind;
  c.section = {.young = 5e9, .poisson = 0.3, .thickness = 0.3, .density = 917};
  c.cracks = {{{6.4, 0}, {6.4, 4}}};
  c.foundations = {Foundation{.modulus = 1e4, .patch = {}}};
  c.loads = {wheel(begin, end, speed, 0.3, -50e3)};
  return c;
}

double deflection(const Formulation& plate, const Point& x, const State& state) {
  double w = 0;
  for (const auto& share : plate.interpolation(x)) w += share.weight * state(0, share.point);
  return w;
}

/// The deflection at a place under the wheel that rests somewhere.
double at_rest(cases::Case c, const Point& x, const Point& of_wheel) {
  auto& pressure = std::get<Pressure>(c.loads.front().action);
  for (auto& corner : std::get<geometry::Polygon>(*pressure.patch).vertices) corner += of_wheel - pressure.path.front();
  pressure.path.clear();
  const auto plate = vp::assembled(c);
  return deflection(
      *plate, x,
      solve_static(*plate, plate->total_load(), StaticMethod::direct, Preconditioning::automatic, {}, no_state())
          .solution.state);
}

struct Crossing {
  double apart = 0, imbalance = 0;  // of the largest deflection, of the largest strain energy
  std::size_t steps = 0;
};

/// Compares the deflection at a place under a slow wheel with that under wheels at rest. `rests`: the plate starts in
/// equilibrium.
Crossing crossing(const cases::Case& c, const Point& x, std::size_t rows, bool rests) {
  const auto& pressure = std::get<Pressure>(c.loads.front().action);
  const auto &begin = pressure.path.front(), &end = pressure.path.back();
  const double half = (std::get<geometry::Polygon>(*pressure.patch).vertices[2] - begin).x();
  const auto [low, high] = geometry::bounding_box(c.outline);
  const auto plate = vp::assembled(c);
  DynamicOptions options;
  options.time_step = 0.8 * stable_time_step(*plate, 1);
  options.steps = std::size_t((end - begin).norm() / pressure.speed / options.time_step) + 1;
  options.observe_every = options.steps / rows;
  if (rests) options.start = start_of(*plate, {});
  Crossing found{.steps = options.steps};
  double most = 0, energy = 0;
  central_differences(*plate, plate->constraints(), plate->mass(), plate->loads(), options, [&](const Instant& now) {
    const Point at = begin + pressure.speed * now.time * (end - begin).normalized();
    const Point near = at.cwiseMax(low).cwiseMin(high);
    const double still = (at - near).norm() < 0.8 * half ? at_rest(c, x, at) : 0;
    found.apart = std::max(found.apart, std::abs(deflection(*plate, x, now.state) - still));
    most = std::max(most, std::abs(still)), energy = std::max(energy, now.strain_energy);
    found.imbalance =
        std::max(found.imbalance, std::abs(now.strain_energy + now.discrete_kinetic_energy - now.external_work));
  });
  found.apart /= most, found.imbalance /= energy;
  return found;
}

}  // namespace

TEST_CASE("a slow wheel drives onto a plate, across it and off: the influence line, and its energies") {
  for (const auto* kind : formulations()) {  // a wave takes 0.02 of the time that the wheel takes
    const auto found = crossing(on_soil(kind, wheel({-0.2, 0.3}, {1.2, 0.3}, 0.02)), {0.5, 0.3}, 28, false);
    CAPTURE(kind->name, found.steps, found.apart, found.imbalance);
    CHECK(found.apart < 0.003);     // 0.0013, 0.0015
    CHECK(found.imbalance < 1e-8);  // below 1e-10
  }
}

TEST_CASE("a wheel at 0.1 m/s over ice, oblique and across a crack: the influence line, and its energies") {
  for (const auto* kind : formulations()) {
    const auto found = crossing(on_ice(kind, {5.13, 1.61}, {7.91, 3.37}, 0.1), {6.17, 2.39}, 16, true);
    CAPTURE(kind->name, found.steps, found.apart, found.imbalance);
    CHECK(found.apart < 0.005);     // 0.0030, 0.0016
    CHECK(found.imbalance < 1e-8);  // 1e-10
  }
}

TEST_CASE("a plate that starts in equilibrium under a wheel rests until it goes on") {
  for (const auto* kind : formulations()) {
    const auto plate = vp::assembled(on_soil(kind, wheel({0.3, 0.3}, {0.7, 0.3}, 1e-9)));
    DynamicOptions options;
    options.time_step = 0.8 * stable_time_step(*plate, 1);
    options.steps = 400, options.observe_every = 50;
    options.start = start_of(*plate, {});
    REQUIRE(options.start.size() > 0);
    double kinetic = 0, strain = 0, imbalance = 0;
    central_differences(*plate, plate->constraints(), plate->mass(), plate->loads(), options, [&](const Instant& now) {
      kinetic = std::max(kinetic, now.kinetic_energy), strain = now.strain_energy;
      imbalance = std::max(imbalance, std::abs(now.strain_energy + now.kinetic_energy - now.external_work));
    });
    CAPTURE(kind->name, kinetic / strain, imbalance / strain);
    CHECK(kinetic < 1e-8 * strain);
    CHECK(imbalance < 1e-6 * strain);
  }
}

TEST_CASE("a force beside the plate does nothing") {
  for (const auto* kind : formulations()) {
    const Load load{PointForce{.value = 1, .path = {{-0.5, 0.3}, {1.5, 0.3}}, .speed = 1}};
    const auto plate = vp::assembled(on_soil(kind, load));
    const auto& moving = *plate->loads().front().moving;
    CHECK(moving.whole(0.4, plate->points()).isZero(0));
    CHECK(moving.whole(1, plate->points()).row(0).sum() == Approx(1));
    CHECK(moving.whole(1.6, plate->points()).isZero(0));
  }
}
