// Plates that move in their plane and across it: a strip that is pulled against the waves of a bar, free vibrations
// beyond the thickness against the one-term solution, rigid motions, and the equilibrium that a damped plate reaches.
#include "plate/solve/motion/stretched_motion.hpp"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "geometry/lattice/cloud.hpp"
#include "plate/bonds/ordinary_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/interpolation.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
using geometry::Point;
namespace vp = verified_plate;

namespace {

constexpr double pi = std::numbers::pi;

/// A plate and its plane, and their motion by 0.9 of the stable step.
struct Moving {
  Discretised plates;
  StretchedMotion both;
  double limit;

  explicit Moving(const cases::Case& c)
      : plates(discretise(c)),
        both(*plates.plate, *plates.membrane, 1),
        limit(stable_time_step(*plates.plate, *plates.membrane, 1)) {}

  void move(DynamicOptions options, double duration, const std::function<void(const Instant&)>& see) const {
    options.steps = std::size_t(std::ceil(duration / (0.9 * limit)));
    options.time_step = duration / double(options.steps);
    if (both.stretching()) options.strain_energy = [&](const State& state) { return both.strain_energy(state); };
    central_differences(both, both.constraints(), both.mass(), both.loads(), options, see);
  }

  /// A component at a place: w of the plate, or u (2) in its plane.
  double at(const State& state, const Point& x, int component) const {
    const State values = component == 0 ? of_plate(state) : of_plane(state);
    double sum = 0;
    for (const auto& share : plates.plate->interpolation(x)) sum += share.weight * values(component, share.point);
    return sum;
  }
};

/// The square of side 1 with hard supports whose edges keep their normal displacement.
cases::Case square(int cells, double h) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 1.0 / cells);
  c.discretization.formulation = &plate::galerkin;
  c.section = {1000, 0.3, h, 5.0 / 6, 2};
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  c.supports[0].in_plane = InPlane::normal;
  c.loads.clear();
  c.stretches = true;
  return c;
}

/// Frequency of the lowest wave of the thin square [1 / time].
double frequency(const Section& s) {
  return pi * std::sqrt(s.bending_stiffness() / s.mass());
}

struct Vibration {
  double period = 0, drift = 0;  // drift: largest change of the energy, relative
};

/// Free vibration from w = amplitude sin(pi x) sin(pi y) over some periods of the linear plate.
Vibration vibration(cases::Case c, double amplitude, double periods) {
  c.initial = Initial{Formula(fmt::format("{:.17g} * sin(pi * x) * sin(pi * y)", amplitude)), {}};
  const Moving moving(c);
  const auto begin = begin_of_motion(*moving.plates.plate, 1);
  DynamicOptions options;
  options.start = moving.both.deflected(begin.deflected), options.bent = true;
  options.given = begin.given + moving.both.energy_in_plane(options.start);
  Vibration result;
  std::vector<double> zeros;
  double before = 0, time_before = 0, first = 0;
  moving.move(options, periods / frequency(c.section), [&](const Instant& now) {
    const double w = moving.at(now.state, {0.5, 0.5}, 0);
    if (now.step > 0 && w * before < 0) zeros.push_back(time_before + (now.time - time_before) * before / (before - w));
    before = w, time_before = now.time;
    const double energy = now.strain_energy + now.discrete_kinetic_energy;
    if (now.step == 0) first = energy;
    result.drift = std::max(result.drift, std::abs(energy - first) / options.given);
  });
  REQUIRE(zeros.size() > 4);
  result.period = 2 * (zeros.back() - zeros.front()) / double(zeros.size() - 1);
  return result;
}

/// Ratio of the frequencies of m W'' + k W (1 + e (W / h)^2) = 0 from W = h at rest to those of small W: by the
/// complete elliptic integral K, found by the arithmetic-geometric mean.
double backbone(double e) {
  double a = 1, b = std::sqrt(1 - e / (2 * (1 + e)));
  while (a - b > 1e-15) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b), a = mean;
  }
  return a * std::sqrt(1 + e);
}

}  // namespace

TEST_CASE("stretched motion: a strip that is pulled at once moves as a bar does", "[in_plane]") {
  // u of the free end: N L / (E h) times a triangle from 0 to 2 with the period 4 L / sqrt(E / rho)
  constexpr double L = 2, N = 3;
  std::vector<double> errors;
  for (const double spacing : {0.05, 0.025}) {
    auto c = vp::free_plate(geometry::rectangle(0, 0, L, 0.25), spacing);
    c.discretization.formulation = &plate::galerkin;
    c.section = {1000, 0, 0.1, 5.0 / 6, 2};
    c.supports = {vp::held(SupportKind::in_plane, {"left"})};
    c.supports[0].in_plane = InPlane::normal;
    c.loads = {{EdgeTraction{{"right"}, N}}};
    const Moving moving(c);
    const double speed = std::sqrt(c.section.young / c.section.density), unit = N * L / (c.section.young * 0.1);
    double squares = 0, count = 0, imbalance = 0, across = 0;
    moving.move({}, 8 * L / speed, [&](const Instant& now) {
      const double phase = std::fmod(speed * now.time / L, 4);
      const double error = moving.at(now.state, {L, 0.125}, 2) / unit - (phase < 2 ? phase : 4 - phase);
      squares += error * error, ++count;
      const double energy = now.strain_energy + now.discrete_kinetic_energy;
      imbalance = std::max(imbalance, std::abs(energy - now.external_work));
      across = std::max(
          {across, of_plate(now.state).cwiseAbs().maxCoeff(), of_plane(now.state).row(1).cwiseAbs().maxCoeff()});
    });
    errors.push_back(std::sqrt(squares / count));
    CHECK(imbalance < 3e-3 * N * unit);  // 0.18 and 0.11 %: the load acts at once in the first step
    CHECK(across < 0.01 * unit);         // 0.8 %: at the fronts of waves that the points do not resolve
  }
  CAPTURE(errors[0], errors[1]);
  CHECK(errors[0] < 0.02);             // 1.5 %
  CHECK(errors[0] / errors[1] > 1.5);  // 2.2
}

TEST_CASE("stretched motion: a square vibrates faster beyond its thickness, and keeps its energy", "[in_plane]") {
  // One term w = W sin sin with its exact u, v for edges that keep u_n = 0 and N_nt = 0 (H.-N. Chu, G. Herrmann 1956):
  // U2 = pi^4 D W^2 / (2 a^2), U4 = pi^4 E h W^4 (3 - nu) / (128 (1 - nu) a^2), hence k3 h^2 / k1 = 3 (3 - nu) (1 + nu)
  // / 8 of a thin plate; shear makes k1 less by 1 + 2 pi^2 D / (S a^2)
  const double h = 0.05;
  const auto c = square(12, h);
  const double nu = c.section.poisson;
  const double soft = 1 + 2 * pi * pi * c.section.bending_stiffness() / c.section.shear_stiffness();
  const double expected = backbone(3 * (3 - nu) * (1 + nu) / 8 * soft);
  const auto small = vibration(c, 1e-3 * h, 5), large = vibration(c, h, 15);
  const double found = small.period / large.period;
  CAPTURE(expected, found, small.drift, large.drift);
  CHECK(small.period * frequency(c.section) == Approx(1).epsilon(0.03));  // 1.6 %
  CHECK(expected == Approx(1.41).epsilon(0.01));
  CHECK(found == Approx(expected).epsilon(0.02));  // -1.9 %
  CHECK(small.drift < 1e-6);                       // 1e-10
  CHECK(large.drift < 3e-4);                       // 6e-5 over 21 periods
}

TEST_CASE("stretched motion: bonds vibrate as the Galerkin plate does", "[in_plane]") {
  const double h = 0.05;
  auto c = square(20, h);
  c.discretization.formulation = &plate::ordinary;
  const auto small = vibration(c, 0.01 * h, 3), large = vibration(c, h, 3);
  CHECK(small.period * frequency(c.section) == Approx(1).epsilon(0.005));  // -0.2 %; Galerkin, 20 points: 1.2 %
  CHECK(small.period / large.period == Approx(1.407).epsilon(0.02));       // 1.388; 1.397
  CHECK(small.drift < 1e-7);                                               // 5e-9
  CHECK(large.drift < 3e-4);                                               // 5e-5
}

TEST_CASE("stretched motion: bonds of a strip that is pulled at once move as a bar does", "[in_plane]") {
  constexpr double L = 2, N = 3;
  auto c = vp::free_plate(geometry::rectangle(0, 0, L, 0.25), 0.05);
  c.section = {1000, 0, 0.1, 5.0 / 6, 2};
  c.supports = {vp::held(SupportKind::in_plane, {"left"})};
  c.supports[0].in_plane = InPlane::normal;
  c.loads = {{EdgeTraction{{"right"}, N}}};
  c.joined_with_plane = true;
  const Moving moving(c);
  const double speed = std::sqrt(c.section.young / c.section.density), unit = N * L / (c.section.young * 0.1);
  double squares = 0, count = 0;
  moving.move({}, 8 * L / speed, [&](const Instant& now) {
    const double phase = std::fmod(speed * now.time / L, 4);
    const double error = moving.at(now.state, {L, 0.125}, 2) / unit - (phase < 2 ? phase : 4 - phase);
    squares += error * error, ++count;
  });
  CHECK(std::sqrt(squares / count) < 0.04);
}

TEST_CASE("stretched motion: rigid motions cost no energy, slow tilting next to none", "[in_plane]") {
  auto c = square(4, 0.1);
  c.outline = geometry::rectangle(-1, -1, 1, 1), c.discretization.spacing = 0.25;
  c.supports.clear();
  const Moving moving(c);
  const auto& positions = moving.plates.plate->cloud().positions;
  const double speed = std::sqrt(c.section.young / c.section.density);
  const auto moved = [&](const Eigen::Vector3d& along, double turn, double tilt, double duration) {
    State plate = zero_state(positions.size()), plane = plate;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const Point& x = positions[k];
      plate.col(Eigen::Index(k)) << along.z() + tilt * x.x(), 0, -tilt;
      const Point v = along.head<2>() + turn * Point(-x.y(), x.x());
      plane.col(Eigen::Index(k)) << 0, -v.y(), v.x();
    }
    DynamicOptions options;
    options.velocity = stacked(plate, plane);
    double largest = 0;
    moving.move(options, duration,
                [&](const Instant& now) { largest = std::max(largest, now.strain_energy / now.kinetic_energy); });
    return largest;
  };
  CHECK(moved({0.7, -0.4, 1}, 0.3, 0, 1) < 1e-18);
  // the forces rho h omega^2 x pull at a plate that tilts at the rate omega: 0.4 (omega / c)^2 of its kinetic energy
  const double rate = speed / 1000;
  CHECK(moved({0, 0, 0}, 0, rate, 0.1 / rate) < 1e-5);  // 1.5e-6
}

TEST_CASE("stretched motion: a damped plate comes to rest in its equilibrium", "[in_plane]") {
  const double h = 0.05;
  auto c = square(12, h);
  const double f = frequency(c.section);
  c.loads = {{Pressure{60 * c.section.young * std::pow(h, 4)}}};
  c.loads[0].history.kind = History::Kind::ramp, c.loads[0].history.rise_time = 2 / f;
  const Moving moving(c);
  const auto &plate = *moving.plates.plate, &membrane = *moving.plates.membrane;
  const auto rest =
      StretchedPlate(plate, membrane).equilibrium({plate.total_load(), membrane.total_load()}, {1e-10, {}});
  REQUIRE(rest.converged);
  CHECK(rest.bending.row(0).cwiseAbs().maxCoeff() > h);
  DynamicOptions options;
  options.mass_damping = 2 * pi * f, options.observe_every = 100;
  State end;
  double imbalance = 0, work = 0;
  moving.move(options, 8 / f, [&](const Instant& now) {
    end = now.state, work = now.external_work;
    const double energy = now.strain_energy + now.discrete_kinetic_energy + now.dissipated;
    imbalance = std::max(imbalance, std::abs(energy - now.external_work));
  });
  CHECK((of_plate(end) - rest.bending).norm() < 1e-8 * rest.bending.norm());  // 6e-11
  CHECK((of_plane(end) - rest.membrane).norm() < 1e-6 * rest.membrane.norm());
  CHECK(imbalance < 1e-3 * work);
}
