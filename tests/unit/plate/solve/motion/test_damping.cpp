#include "plate/solve/motion/time_grid.hpp"

#include <numbers>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/solve/motion/chain.hpp"

using namespace plate;
using spring_chain::Chain, spring_chain::Inverse;

namespace {

/// One point between two springs: omega^2 = 2 / mass.
struct Single {
  Chain chain{1};
  Inverse inverse{chain};
  Constraints constraints;
  Forces mass = Forces::Zero(3, 1);
  State at = State::Zero(3, 1), moving = at;

  Single() {
    mass(0, 0) = 0.5, at(0, 0) = 0.3, moving(0, 0) = -0.7;  // omega = 2
    constraints.fix(dof(0, 1)), constraints.fix(dof(0, 2));
    constraints.resolve();
  }
};

/// Options of its motion from a velocity alone, with stiffness-proportional damping that relaxes.
DynamicOptions relaxing(const Single& s, double beta, double relaxation, double time_step, std::size_t steps) {
  DynamicOptions options{time_step, steps, std::max<std::size_t>(1, steps / 60)};
  options.mass_damping = 0.1, options.stiffness_damping = beta, options.relaxation = relaxation;
  options.velocity = s.moving, options.given = 0.25 * 0.49;
  return options;
}

/// y of y'' + drag y' + 4 y = 0 by tiny steps of fourth order, and the integral of mass drag y'^2.
std::array<double, 2> integrated(double drag, double end) {
  constexpr int steps = 200000;
  const double dt = end / steps;
  std::array<double, 3> s{0.3, -0.7, 0};
  const auto rate = [&](const std::array<double, 3>& x) {
    return std::array<double, 3>{x[1], -drag * x[1] - 4 * x[0], 0.5 * drag * x[1] * x[1]};
  };
  const auto plus = [](std::array<double, 3> a, const std::array<double, 3>& b, double f) {
    for (std::size_t i = 0; i < 3; ++i) a[i] += f * b[i];
    return a;
  };
  for (int n = 0; n < steps; ++n) {
    const auto a = rate(s), b = rate(plus(s, a, dt / 2)), c = rate(plus(s, b, dt / 2)), d = rate(plus(s, c, dt));
    for (std::size_t i = 0; i < 3; ++i) s[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return {s[0], s[2]};
}

}  // namespace

TEST_CASE("damping: of ratios at two frequencies") {
  const auto d = damping_of({0.02, 0.05}, {3, 11});
  const auto ratio = [&](double f) {
    const double omega = 2 * std::numbers::pi * f;
    return d.mass / (2 * omega) + d.stiffness * omega / 2;
  };
  CHECK(ratio(3) == Approx(0.02).epsilon(1e-12));
  CHECK(ratio(11) == Approx(0.05).epsilon(1e-12));
}

TEST_CASE("damping: modes move exactly, below, at and beyond the critical damping, and steps nearly so") {
  const Single s;
  for (const auto& one : std::vector<std::array<double, 2>>{
           {0.2, 0}, {0, 0.05}, {0.3, 0.1}, {4, 0}, {0, 1}, {11, 0}, {3.9999999, 0}, {900, 0}}) {
    const double alpha = one[0], beta = one[1];  // clang captures no structured bindings where OpenMP is on
    const double drag = alpha + 4 * beta;
    const auto [y, lost] = integrated(drag, 2.5);
    CAPTURE(alpha, beta);
    LanczosOptions modes{2.5, 1e-10};
    modes.damping = {alpha, beta}, modes.deflected = s.at, modes.velocity = s.moving;
    double last = 0, dissipated = 0, strained = 0;
    LanczosMotion(s.chain, s.constraints, Inertia(s.mass), {}, s.inverse, modes).observe(7, [&](const Instant& now) {
      last = now.state(0, 0), dissipated = now.dissipated;
      if (now.strained) strained = now.strained()(0, 0) - now.state(0, 0) - beta * now.velocity()(0, 0);
    });
    CHECK(last == Approx(y).epsilon(1e-8).margin(1e-10));
    CHECK(dissipated == Approx(lost).epsilon(1e-6));
    CHECK(std::abs(strained) < 1e-14);

    if (drag > 100) continue;
    constexpr std::size_t steps = 20000;
    DynamicOptions options{2.5 / steps, steps, steps / 4};
    options.mass_damping = alpha, options.stiffness_damping = beta;
    options.start = s.at, options.bent = true, options.velocity = s.moving;
    options.given = 0.3 * 0.3 + 0.25 * 0.49;  // u K u / 2, m v^2 / 2
    std::vector<double> energies;
    central_differences(s.chain, s.constraints, s.mass, {}, options, [&](const Instant& now) {
      last = now.state(0, 0), dissipated = now.dissipated;
      energies.push_back(now.strain_energy + now.discrete_kinetic_energy + now.dissipated - now.external_work);
    });
    CHECK(last == Approx(y).epsilon(1e-3).margin(1e-5));
    CHECK(dissipated == Approx(lost).epsilon(1e-3));
    for (const double energy : energies) CHECK(std::abs(energy - energies[0]) < 1e-11);  // exact but for rounding
  }
}

TEST_CASE("damping: a plate that begins with a velocity stops where its drag says, and what it loses is booked") {
  const Single s;
  for (const double alpha : {1.0, 1e2, 1e4}) {
    const double step = 0.9 * stable_step(1, {alpha, 0});
    CHECK(alpha * step <= 0.1);
    const auto steps = std::size_t(20 / (alpha * step));
    DynamicOptions options{step, steps, steps};
    options.mass_damping = alpha, options.velocity = s.moving, options.given = 0.25 * 0.49;
    double last = 0, dissipated = 0;
    central_differences(s.chain, s.constraints, s.mass, {}, options,
                        [&](const Instant& now) { last = now.state(0, 0), dissipated = now.dissipated; });
    if (alpha < 100) continue;  // it swings
    CHECK(last ==
          Approx(-0.7 / alpha).epsilon(alpha > 1e3 ? 1e-5 : 0.03));  // v / alpha, less what the spring gives back
    CHECK(dissipated == Approx(0.25 * 0.49).epsilon(5e-3));          // (alpha dt / 2)^2 of it is not
  }
}

TEST_CASE("damping: the stable step of steps whose stiffness damps, and no longer one") {
  const Single s;
  const double undamped = 1;  // 2 / omega
  for (const double beta : {0.01, 0.3, 4.0})
    for (const double share : {0.99, 1.01}) {
      DynamicOptions options{share * stable_step(undamped, {0.1, beta}), 4000, 4000};
      options.mass_damping = 0.1, options.stiffness_damping = beta, options.start = s.at, options.bent = true;
      double last = 0;
      const auto run = [&] {
        central_differences(s.chain, s.constraints, s.mass, {}, options,
                            [&](const Instant& now) { last = std::abs(now.state(0, 0)); });
      };
      if (share < 1) {
        run();
        CHECK(last < 0.3);
        continue;
      }
      try {
        run();
        CHECK(last > 1);
      } catch (const NumericalError&) {
        SUCCEED("beyond what numbers hold");
      }
    }
}

TEST_CASE("damping: a force that relaxes leaves half of the undamped step, and no longer one") {
  const Single s;
  CHECK(damped_step(1, {0.1, 0.01}, 1e9).relaxation == 0);
  CHECK(damped_step(1, {0.1, 4}, 0.9 / exact_below({0.1, 4})).relaxation == 0);
  CHECK(damped_step(1, {0.1, 0.01}, 1e9).limit == stable_step(1, {0.1, 0.01}));
  CHECK(damped_step(1, {10, 4}, 1e9).limit == Approx(0.01));  // by the mass
  for (const double beta : {1.0, 4.0, 1e3}) {
    const auto [limit, relaxation] = damped_step(1, {0.1, beta}, 1e9);
    CHECK(limit == 0.5);
    CHECK(relaxation == Approx(beta / 3));
    for (const double share : {0.999, 1.1}) {  // tanh(x) / x of the bound: 1.03 at beta = 1
      auto options = relaxing(s, beta, relaxation, share * limit, 2000);
      options.start = s.at, options.bent = true;
      double last = 0;
      try {
        central_differences(s.chain, s.constraints, s.mass, {}, options,
                            [&](const Instant& now) { last = std::abs(now.state(0, 0)); });
      } catch (const NumericalError&) {
        last = 1e300;
      }
      CAPTURE(beta, share, last);
      CHECK((share < 1 ? last < 0.3 : last > 1));
    }
  }
}

TEST_CASE("damping: a force that relaxes moves and dissipates as its equations say, and its energies close") {
  const Single s;
  for (const double ratio : {0.02, 0.12, 0.5}) {
    const double beta = ratio, tau = beta / 3;  // ratio = beta omega / 2, omega = 2
    std::array<double, 4> y{0, -0.7, 0, 0};     // y, y', strain beside it, loss; tau s' + s = beta y'
    constexpr std::size_t steps = 40000;
    const double end = 5, dt = end / steps;
    const auto rate = [&](const std::array<double, 4>& x) {
      return std::array<double, 4>{x[1], -0.1 * x[1] - 4 * (x[0] + x[2]), (beta * x[1] - x[2]) / tau,
                                   0.05 * x[1] * x[1] + 2 * x[2] * x[1]};
    };
    for (std::size_t n = 0; n < steps; ++n) {
      const auto first = rate(y);
      auto middle = y;
      for (std::size_t i = 0; i < 4; ++i) middle[i] += dt / 2 * first[i];
      const auto slope = rate(middle);
      for (std::size_t i = 0; i < 4; ++i) y[i] += dt * slope[i];
    }
    double last = 0, dissipated = 0, strained = 0;
    std::vector<double> energies;
    central_differences(s.chain, s.constraints, s.mass, {}, relaxing(s, beta, tau, dt, steps), [&](const Instant& now) {
      last = now.state(0, 0), dissipated = now.dissipated, strained = now.strained()(0, 0) - last;
      energies.push_back(now.strain_energy + now.discrete_kinetic_energy + now.dissipated - now.external_work);
    });
    CAPTURE(ratio);
    CHECK(last == Approx(y[0]).margin(1e-4));
    CHECK(strained == Approx(y[2]).margin(1e-4));
    CHECK(dissipated == Approx(y[3]).epsilon(1e-3));
    for (const double energy : energies) CHECK(std::abs(energy - energies[0]) < 1e-11);  // exact but for rounding
  }
}

TEST_CASE("damping: a motion that goes on from what it remembers has the same numbers") {
  const Single s;
  auto options = relaxing(s, 0.2, GENERATE(0.0, 0.06), 0.05, 60);
  options.observe_every = 10;
  std::vector<std::array<double, 4>> whole, rest;
  std::optional<MotionCheckpoint> kept;
  std::size_t asked = 0;
  options.due = [&] { return ++asked == 24; };
  options.save = [&](const MotionCheckpoint& memory) { kept = memory; };
  const auto see = [](auto& into) {
    return [&into](const Instant& now) {
      into.push_back({now.state(0, 0), now.dissipated, now.external_work, now.kinetic_energy});
    };
  };
  central_differences(s.chain, s.constraints, s.mass, {}, options, see(whole));
  REQUIRE(kept);
  auto again = options;
  again.from = &*kept, again.save = {}, again.due = {};
  central_differences(s.chain, s.constraints, s.mass, {}, again, see(rest));
  REQUIRE(rest.size() < whole.size());
  for (std::size_t i = 0; i < rest.size(); ++i) CHECK(rest[i] == whole[whole.size() - rest.size() + i]);
}
