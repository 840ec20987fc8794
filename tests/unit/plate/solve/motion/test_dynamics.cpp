#include "plate/solve/motion/dynamics.hpp"

#include "plate/bonds/rows/lattice_operator.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/small_plate.hpp"

using namespace plate;
using small_plate::section;

namespace {

small_plate::Model model(const std::vector<Support>& supports, double width = 0.8) {
  return small_plate::model(geometry::rectangle(0, 0, width, 0.6), supports, small_plate::spaced(0.1));
}

small_plate::Model held() {
  using enum SupportKind;
  return model({{clamped, {"left"}, {}}, {simply_supported, {"right"}, {}}});
}

Forces mass_of(const small_plate::Model& m) {
  return mass(section, m.boundary.cloud.areas, m.boundary.active, m.boundary.constraints);
}

std::vector<TimedLoad> pressure(const small_plate::Model& m, double value, const History& history = {}) {
  const Load load{Pressure{.value = value}};
  return {{nodal_forces(load, m.boundary.cloud, m.outline), history}};
}

}  // namespace

TEST_CASE("mass: rho h and rho h^3 / 12 times the area, carried to what a point follows") {
  const auto m = model({{SupportKind::simply_supported, {"left"}, {}}});
  const Forces all = mass_of(m);
  const double h = section.thickness, unit = section.density * h * 0.01;
  CHECK(all(0, 4) == Approx(unit));
  CHECK(all(1, 4) == Approx(unit * h * h / 12));
  CHECK(all(2, 0) == Approx(unit * h * h / 12));
  CHECK(all(0, 0) == 0);  // follows the second point
  CHECK(all(0, 1) == Approx(unit * (1 + 1.0 / 9)));
  const auto mirrored = held();
  const Forces beyond = mass_of(mirrored).rightCols(mirrored.points() - 48);
  REQUIRE(beyond.cols() == 18);
  CHECK(beyond.norm() == 0);
}

TEST_CASE("a free plate under constant pressure moves by p t^2 / (2 rho h)") {
  const auto m = model({});
  const double p = 3, dt = 0.01, acceleration = p / (section.density * section.thickness);
  std::size_t seen = 0;
  central_differences(
      m.plate, m.boundary.constraints, mass_of(m), pressure(m, p), {dt, 40, 10}, [&](const Instant& now) {
        const double t = double(now.step) * dt;
        CHECK(now.time == Approx(t));
        CHECK((now.state.row(0).array() - acceleration * t * t / 2).abs().maxCoeff() < 1e-13);  // measured: 2e-16
        CHECK((now.velocity().row(0).array() - acceleration * t).abs().maxCoeff() < 1e-13);     // measured: 1e-15
        CHECK(now.state.bottomRows(2).cwiseAbs().maxCoeff() < 1e-12);                           // measured: 0
        const double kinetic = section.density * section.thickness * 0.48 / 2 * std::pow(acceleration * t, 2);
        CHECK(now.kinetic_energy == Approx(kinetic).epsilon(1e-12));
        CHECK(now.external_work == Approx(kinetic).epsilon(1e-12));
        ++seen;
      });
  CHECK(seen == 5);
}

TEST_CASE("a free plate under a ramp: the work is the kinetic energy") {
  const auto m = model({});
  const double p = 3, rise = 0.5, dt = 0.002;
  const History ramp{History::Kind::ramp, rise, 0, {}};
  double kinetic = 0, work = 0, w = 0;
  const DynamicOptions options{dt, 250, 1000};
  central_differences(
      m.plate, m.boundary.constraints, mass_of(m), pressure(m, p, ramp), options,
      [&](const Instant& now) { kinetic = now.kinetic_energy, work = now.external_work, w = now.state(0, 0); });
  // w'' = p t / (rho h rise): w = p t^3 / (6 rho h rise), work = p^2 A t^4 / (8 rho h rise^2)
  const double rho_h = section.density * section.thickness;
  CHECK(w == Approx(p * rise * rise / (6 * rho_h)).epsilon(1e-4));                // measured: 2e-5, O(dt^2)
  CHECK(work == Approx(p * p * 0.48 * rise * rise / (8 * rho_h)).epsilon(1e-4));  // measured: 2e-5, O(dt^2)
  CHECK(work == Approx(kinetic).epsilon(1e-4));                                   // measured: 2e-5
}

TEST_CASE("kinetic and strain energy are the work of the load") {
  const auto m = held();
  const auto M = mass_of(m);
  const double dt = 0.25 * stable_time_step(m.plate, m.boundary.constraints, M);
  const auto history = GENERATE(History{}, History{History::Kind::sine, 0, 3, {}});
  double worst = 0, largest = 0;
  const DynamicOptions options{dt, 400, 1};
  central_differences(m.plate, m.boundary.constraints, M, pressure(m, 2, history), options, [&](const Instant& now) {
    const double strain = m.plate.energies(now.state).sum();
    worst = std::max(worst, std::abs(now.kinetic_energy + strain - now.external_work));
    largest = std::max(largest, strain);
  });
  CHECK(largest > 0);
  CHECK(worst < 0.02 * largest);  // measured: 1e-4, O(dt^2)
}

TEST_CASE("observed at the start, every so many steps, and at the end") {
  const auto m = model({});
  std::vector<std::size_t> steps;
  central_differences(m.plate, m.boundary.constraints, mass_of(m), pressure(m, 1), {0.001, 10, 4},
                      [&](const Instant& now) { steps.push_back(now.step); });
  CHECK(steps == std::vector<std::size_t>{0, 4, 8, 10});
}

TEST_CASE("forces in single precision move a thick plate as those in double do") {
  const auto m = held();
  const LatticeOperator rows{FamilyOperator(m.plate)};
  const auto M = mass_of(m);
  DynamicOptions options{0.9 * stable_time_step(m.plate, m.boundary.constraints, M), 200, 20};
  std::vector<State> states;
  const auto keep = [&](const Instant& now) { states.push_back(now.state); };
  central_differences(rows, m.boundary.constraints, M, pressure(m, 2), options, keep);
  options.single = [single = rows.single_rows()](const Values<float>& u, Values<float>& f) {
    single.internal_force(u, f);
  };
  central_differences(rows, m.boundary.constraints, M, pressure(m, 2), options, keep);
  REQUIRE(states.size() == 22);
  for (std::size_t i = 1; i < 11; ++i) {
    CHECK((states[i] - states[i + 11]).norm() <
          2e-5 * states[i].norm());  // measured: 5e-6 where it passes through zero
    CHECK(states[i] != states[i + 11]);
  }
}

TEST_CASE("velocities fulfil the constraints too") {
  const auto m = held();
  const auto M = mass_of(m);
  const double dt = 0.9 * stable_time_step(m.plate, m.boundary.constraints, M);
  central_differences(m.plate, m.boundary.constraints, M, pressure(m, 2), {dt, 20, 10}, [&](const Instant& now) {
    State u = now.state, v = now.velocity();
    m.boundary.constraints.impose(u);
    m.boundary.constraints.impose(v);
    CHECK(u == now.state);
    CHECK(v == now.velocity());
    CHECK((now.step == 0 || v.norm() > 0));
  });
}

TEST_CASE("an unstable step is an error with its step and point") {
  const auto m = held();
  const auto M = mass_of(m);
  const double dt = 10 * stable_time_step(m.plate, m.boundary.constraints, M);
  const auto run = [&] {
    central_differences(m.plate, m.boundary.constraints, M, pressure(m, 1), {dt, 400, 5}, [](const Instant&) {});
  };
  CHECK_THROWS_AS(run(), NumericalError);
  CHECK_THROWS_WITH(run(), Catch::Contains("step") && Catch::Contains("point"));
}

TEST_CASE("a motion that goes on from its memory moves as if it had never stopped, to the last digit") {
  const auto m = held();
  const Load second{Pressure{.value = -2}};
  auto loads = pressure(m, 3, {History::Kind::table, 0, 0, {{0, 0}, {0.02, 1}, {0.05, -1}}});
  loads.push_back({nodal_forces(second, m.boundary.cloud, m.outline), {}});
  const State start = GENERATE(false, true) ? State(State::Zero(3, Eigen::Index(m.points()))) : State();
  struct Seen {
    State state, velocity;
    double work, strain, discrete;
    bool operator==(const Seen&) const = default;
  };
  const auto move = [&](const MotionCheckpoint* from, std::size_t kept_at, std::vector<MotionCheckpoint>* kept) {
    std::vector<Seen> rows;
    DynamicOptions options{0.002, 30, 3};
    options.start = start;
    options.from = from;
    std::size_t asked = from ? from->step : 0;
    options.due = [&] { return asked++ == kept_at; };
    if (kept) options.save = [&](const MotionCheckpoint& memory) { kept->push_back(memory); };
    central_differences(m.plate, m.boundary.constraints, mass_of(m), loads, options, [&](const Instant& now) {
      rows.push_back({now.state, now.velocity(), now.external_work, now.strain_energy,
                      now.discrete_kinetic_energy + now.potential});
    });
    return rows;
  };
  const auto whole = move(nullptr, 0, nullptr);
  REQUIRE(whole.size() == 11);
  for (const std::size_t step : {1, 3, 14, 30}) {
    std::vector<MotionCheckpoint> kept;
    CHECK(move(nullptr, step, &kept) == whole);
    REQUIRE(kept.size() == (step == 30 ? 1 : 2));  // and that of the last step, from which a longer motion goes on
    REQUIRE(kept[0].step == step);
    REQUIRE(kept.back().step == 30);
    const auto rest = move(&kept[0], 0, nullptr);
    const auto rows = std::size_t((30 - step) / 3 + 1);
    REQUIRE(rest.size() == rows);
    CHECK(std::equal(rest.begin(), rest.end(), whole.end() - std::ptrdiff_t(rows)));
  }
}
