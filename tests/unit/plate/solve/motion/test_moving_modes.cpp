#include "plate/solve/motion/lanczos_motion.hpp"

#include "plate/model/loads.hpp"
#include "plate/model/nodal_forces.hpp"
#include "tests/catch.hpp"

using namespace plate;

namespace {

History table(std::vector<std::pair<double, double>> pairs) {
  return {History::Kind::table, 0, 0, std::move(pairs)};
}

/// Amplitudes at the end by the method of Runge and Kutta, in steps that end at the corners of the histories.
Eigen::VectorXd in_small_steps(const Eigen::VectorXd& squares, const Eigen::MatrixXd& shares,
                               const std::vector<TimedLoad>& loads, double end, std::size_t steps) {
  const auto size = squares.size();
  const auto rate = [&](double time, const Eigen::VectorXd& y) {
    Eigen::VectorXd factors(shares.cols()), result(2 * size);
    for (Eigen::Index l = 0; l < factors.size(); ++l) factors[l] = factor(loads[std::size_t(l)].history, time);
    result << y.tail(size), shares * factors - squares.cwiseProduct(y.head(size));
    return result;
  };
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * size);
  const double h = end / double(steps);
  for (std::size_t n = 0; n < steps; ++n) {
    const double t = h * double(n);
    const Eigen::VectorXd a = rate(t, y), b = rate(t + h / 2, y + h / 2 * a), c = rate(t + h / 2, y + h / 2 * b),
                          d = rate(t + h * (1 - 1e-12), y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y;
}

const Eigen::VectorXd squares{{1, 9, 400}};
const Eigen::MatrixXd shares{{1, 0.5}, {-2, 1}, {3, 7}};

}  // namespace

TEST_CASE("moving modes: as in small steps, for any rows, and the work of the loads is the energy") {
  const std::vector<TimedLoad> loads{{{}, table({{0.5, 0}, {1, 2}, {1.5, -1}})},
                                     {{}, {History::Kind::ramp, 1.25, 0, {}}}};
  const auto expected = in_small_steps(squares, shares, loads, 2, 16000);
  for (const int rows : {1, 3, 40}) {
    MovingModes modes(squares, shares, loads);
    for (int i = 0; i < rows; ++i) modes.advance(2.0 * i / rows, 2.0 * (i + 1) / rows);
    CHECK((modes.amplitudes() - expected.head(3)).norm() < 1e-9);  // measured: 1e-12
    CHECK((modes.velocities() - expected.tail(3)).norm() < 1e-8);
    CHECK(modes.strain_energy() + modes.kinetic_energy() == Approx(modes.work()).epsilon(1e-10));
  }
}

TEST_CASE("moving modes: a sine in pieces, a step at once") {
  const std::vector<TimedLoad> loads{{{}, {History::Kind::sine, 0, 0.8, {}}}, {{}, {}}};
  const auto expected = in_small_steps(squares, shares, loads, 2, 16000);
  MovingModes modes(squares, shares, loads);
  modes.advance(0, 2);
  CHECK((modes.amplitudes() - expected.head(3)).norm() < 1e-5 * expected.head(3).norm());
  CHECK(modes.strain_energy() + modes.kinetic_energy() == Approx(modes.work()).epsilon(1e-10));
}

TEST_CASE("moving modes: at rest under loads that stay nothing moves, and what loads do later is balanced") {
  const std::vector<TimedLoad> loads{{{}, {}}, {{}, table({{0, 3}, {1, 3}, {2, 0}})}};
  MovingModes modes(squares, shares, loads);
  modes.rest();
  CHECK(modes.work() == Approx(modes.strain_energy()));
  const Eigen::VectorXd before = modes.amplitudes();
  modes.advance(0, 1);
  CHECK((modes.amplitudes() - before).norm() < 1e-13 * before.norm());
  CHECK(modes.kinetic_energy() < 1e-24 * modes.strain_energy());
  CHECK(modes.accelerations(1).norm() < 1e-12 * before.norm());
  CHECK(modes.potential(1) == Approx(-2 * modes.strain_energy()));
  modes.advance(1, 5);
  CHECK(modes.strain_energy() + modes.kinetic_energy() == Approx(modes.work()).epsilon(1e-10));
}
