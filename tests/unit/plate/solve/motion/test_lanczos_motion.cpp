#include <algorithm>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/solve/motion/chain.hpp"

using namespace plate;
using spring_chain::Chain, spring_chain::Inverse;

namespace {

constexpr Eigen::Index points = 120;

struct Moved {
  std::size_t vectors = 0;
  double change = 0;
  std::vector<double> time, w, kinetic, strain, work, velocity;
};

struct Setting {
  Chain chain{points};
  Inverse inverse{chain};
  Constraints constraints;
  Forces mass = Forces::Zero(3, points), load = Forces::Zero(3, points);

  Setting() {
    for (Eigen::Index i = 0; i < points; ++i)
      mass(0, i) = 1 + 0.005 * double(i), load(0, i) = std::sin(0.3 * double(i));
    for (std::uint32_t k = 0; k < points; ++k) constraints.fix(dof(k, 1)), constraints.fix(dof(k, 2));
    constraints.resolve();
  }

  Moved move(const std::vector<History>& histories, double tolerance, bool from_equilibrium = false) const {
    std::vector<TimedLoad> loads;
    for (const auto& history : histories) loads.push_back({load, history});
    LanczosOptions options{40, tolerance};
    options.from_equilibrium = from_equilibrium;
    Moved result;
    const LanczosMotion motion(chain, constraints, Inertia(mass), loads, inverse, options);
    result.vectors = motion.vectors(), result.change = motion.change();
    motion.observe(80, [&](const Instant& now) {
      result.time.push_back(now.time), result.w.push_back(now.state(0, 7)),
          result.velocity.push_back(now.velocity()(0, 7));
      result.kinetic.push_back(now.kinetic_energy), result.strain.push_back(now.strain_energy),
          result.work.push_back(now.external_work);
    });
    return result;
  }

  /// Computes the motion by central differences in steps so small that they are exact.
  std::vector<double> by_steps(const std::vector<History>& histories) const {
    std::vector<TimedLoad> loads;
    for (const auto& history : histories) loads.push_back({load, history});
    std::vector<double> result;
    constexpr std::size_t each = 500;
    central_differences(chain, constraints, mass, loads, {40.0 / 80 / each, 80 * each, each},
                        [&](const Instant& now) { result.push_back(now.state(0, 7)); });
    return result;
  }
};

History ramp(double rise_time) {
  return {History::Kind::ramp, rise_time, 0, {}};
}

}  // namespace

TEST_CASE("Lanczos motion: that of small steps, under loads of every history") {
  const Setting s;
  const History step, sine{History::Kind::sine, 0, 0.07, {}};
  const History table{History::Kind::table, 0, 0, {{1.3, 0}, {2.1, 1}, {9.7, -0.4}, {30, 0.2}}};
  for (const auto& histories : {std::vector{ramp(3.3)}, {sine}, {step, ramp(7), table}}) {
    const auto found = s.move(histories, 1e-12);
    const auto expected = s.by_steps(histories);
    REQUIRE(found.w.size() == expected.size());
    const double largest = std::abs(*std::max_element(expected.begin(), expected.end(),
                                                      [](double a, double b) { return std::abs(a) < std::abs(b); }));
    for (std::size_t n = 0; n < expected.size(); ++n)
      CHECK(std::abs(found.w[n] - expected[n]) < 3e-5 * largest);  // measured 1e-5: of the steps
    for (std::size_t n = 0; n < expected.size(); ++n)
      CHECK(found.kinetic[n] + found.strain[n] ==
            Approx(found.work[n]).margin(1e-9 * std::abs(found.work.back()) + 1e-12));
  }
}

TEST_CASE("Lanczos motion: velocities are the slopes of the displacements") {
  const Setting s;
  const auto found = s.move({ramp(5)}, 1e-12);
  for (std::size_t n = 1; n + 1 < found.w.size(); ++n)
    CHECK(found.velocity[n] ==
          Approx((found.w[n + 1] - found.w[n - 1]) / (found.time[n + 1] - found.time[n - 1])).margin(0.1));
}

TEST_CASE("Lanczos motion: a few vectors hold a smooth motion, and say how far") {
  const Setting s;
  const auto all = s.move({ramp(20)}, 1e-12), few = s.move({ramp(20)}, 1e-3);
  CHECK(few.vectors < points);
  CHECK(few.change <= 1e-3);
  for (std::size_t n = 0; n < all.w.size(); ++n) CHECK(std::abs(few.w[n] - all.w[n]) < 0.01 * std::abs(all.w.back()));
}

TEST_CASE("Lanczos motion: from equilibrium under a constant load nothing moves, and its work is done") {
  const Setting s;
  const auto found = s.move({History{}}, 1e-12, true);
  for (const double w : found.w) CHECK(w == Approx(found.w.front()).epsilon(1e-9));
  CHECK(found.work.back() == Approx(found.strain.back()).epsilon(1e-12));
  CHECK(found.kinetic.back() < 1e-15 * found.strain.back());
}

TEST_CASE("Lanczos motion: without loads nothing moves") {
  Setting s;
  s.load.setZero();
  const auto found = s.move({History{}}, 1e-3);
  CHECK(found.vectors == 0);
  CHECK(found.w.size() == 81);
  for (const double w : found.w) CHECK(w == 0);
}

TEST_CASE("Lanczos motion: too few vectors are refused") {
  const Setting s;
  LanczosOptions options{400, 1e-9};
  options.max_vectors = 8;
  const std::vector<TimedLoad> loads{{s.load, {}}};
  CHECK_THROWS_AS(LanczosMotion(s.chain, s.constraints, Inertia(s.mass), loads, s.inverse, options), NumericalError);
}

TEST_CASE(
    "Lanczos motion: what is watched is known as well as is asked, and the truncation is not above what is said") {
  const Setting s;
  const std::vector<TimedLoad> loads{{s.load, {}}};
  const auto watched = [&](double tolerance, std::size_t most = 800) {
    LanczosOptions options{40, 1};  // the motion itself is not asked for
    options.max_vectors = most;
    Eigen::MatrixXd group = Eigen::MatrixXd::Zero(2, 3 * points);
    group(0, 3 * 7) = 1, group(1, 3 * 60) = 1, group(1, 3 * 61) = -1;
    options.watched = {group, 10 * group};
    options.watched_tolerance = tolerance;
    return LanczosMotion(s.chain, s.constraints, Inertia(s.mass), loads, s.inverse, options);
  };
  const auto values = [](const LanczosMotion& motion) {
    std::vector<double> result;
    motion.observe(50, [&](const Instant& now) {
      result.push_back(now.state(0, 7)), result.push_back(now.state(0, 60) - now.state(0, 61));
    });
    return result;
  };
  const auto exact = values(LanczosMotion(s.chain, s.constraints, Inertia(s.mass), loads, s.inverse, {40, 1e-12}));
  const double largest = *std::ranges::max_element(exact);
  std::size_t before = 0;
  for (const double tolerance : {0.3, 0.1, 0.03, 0.01}) {
    const auto motion = watched(tolerance);
    REQUIRE(motion.truncated().size() == 2);
    CHECK(motion.truncated()[0] <= tolerance);
    CHECK(motion.truncated()[1] == Approx(motion.truncated()[0]));
    CHECK(motion.vectors() >= before);
    before = motion.vectors();
    const auto found = values(motion);
    for (std::size_t i = 0; i < found.size(); ++i)
      CHECK(std::abs(found[i] - exact[i]) <= motion.truncated()[0] * largest);
  }
  CHECK(before < std::size_t(points));
  CHECK(watched(1e-12, 80).vectors() == 80);  // the motion is known, so that this is no error
}
