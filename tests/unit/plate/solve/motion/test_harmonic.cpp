#include "plate/solve/motion/harmonic.hpp"

#include <Eigen/LU>
#include <numbers>

#include "plate/formulation/constraints.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/model/errors.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/solve/motion/chain.hpp"

using namespace plate;

namespace {

constexpr Eigen::Index points = 60;
const double turn = 2 * std::numbers::pi;

/// A chain between walls with masses that vary, in w alone.
struct VaryingChain {
  spring_chain::Chain chain{points};
  spring_chain::Inverse inverse{chain};
  Constraints constraints;
  Forces mass = Forces::Zero(3, points), load = mass;
  Eigen::MatrixXd stiffness{points, points};

  VaryingChain() {
    for (std::uint32_t k = 0; k < points; ++k) constraints.fix(dof(k, 1)), constraints.fix(dof(k, 2));
    constraints.resolve();
    for (Eigen::Index i = 0; i < points; ++i) mass(0, i) = 1 + 0.1 * double(i % 7), load(0, i) = std::sin(0.3 * i);
    for (Eigen::Index i = 0; i < points; ++i) {
      State unit = State::Zero(3, points);
      unit(0, i) = 1;
      Forces force;
      chain.internal_force(unit, force);
      stiffness.col(i) = -force.row(0).transpose();
    }
  }

  HarmonicResponse response(const HarmonicOptions& options) const {
    return {chain, constraints, Inertia(mass), load, inverse, options};
  }

  /// (K + i omega C - omega^2 M)^-1 F.
  Eigen::VectorXcd exact(double frequency, const Damping& damping) const {
    const double omega = turn * frequency;
    const Eigen::MatrixXd M = mass.row(0).transpose().asDiagonal(),
                          C = damping.mass * M + damping.stiffness * stiffness;
    Eigen::MatrixXcd whole = (stiffness - omega * omega * M).cast<std::complex<double>>();
    whole += std::complex(0.0, omega) * C.cast<std::complex<double>>();
    return whole.fullPivLu().solve(load.row(0).transpose().cast<std::complex<double>>());
  }
};

}  // namespace

TEST_CASE("a sweep: equally far from each other, both ends") {
  CHECK(Sweep{2, 4, 5}.frequencies() == std::vector<double>{2, 2.5, 3, 3.5, 4});
  CHECK(Sweep{2, 4, 1}.frequencies() == std::vector<double>{2});
  CHECK(Sweep{2, 2, 1}.frequencies() == std::vector<double>{2});
}

TEST_CASE("a harmonic response is that of all equations, below, at and between resonances, for three dampings") {
  const VaryingChain chain;
  const double lowest = std::sqrt(chain.stiffness(0, 0) / 1.3) * std::numbers::pi / (points + 1) / turn;  // or near it
  for (const Damping damping : {Damping{1e-3, 0}, Damping{0, 0.3}, Damping{0.02, 0.05}}) {
    const auto response = chain.response({Sweep{0.01 * lowest, 12 * lowest, 24}, damping});
    CHECK(response.change() <= 3e-4);
    CHECK(response.vectors() < std::size_t(points));
    REQUIRE(response.frequencies().size() == 24 + response.resonances().size());
    CHECK(response.resonances().size() > 3);
    CHECK(std::ranges::is_sorted(response.frequencies()));
    double off = 0;
    for (std::size_t n = 0; n < response.frequencies().size(); ++n) {
      const auto exact = chain.exact(response.frequencies()[n], damping);
      const auto [a, b] = response.at(n);
      const Eigen::VectorXcd found = a.row(0).transpose() + std::complex(0.0, 1.0) * b.row(0).transpose();
      CHECK(a.bottomRows(2).norm() + b.bottomRows(2).norm() == 0);
      off = std::max(off, (found - exact).norm() / exact.norm());
    }
    CAPTURE(damping.mass, damping.stiffness, response.vectors(), response.resonances().size());
    CHECK(off < 3e-4);
  }
}

TEST_CASE("a harmonic response: resonances are those of the plate without damping, and what is watched is known") {
  const VaryingChain chain;
  const Eigen::VectorXd root = chain.mass.row(0).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(root.asDiagonal() * chain.stiffness * root.asDiagonal());
  HarmonicOptions options{Sweep{1e-4, 1.05 * std::sqrt(modes.eigenvalues()[5]) / turn, 10}, Damping{1e-3, 0}};
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(1, 3 * points);
  slope(0, 3 * 30) = -1, slope(0, 3 * 31) = 1;
  options.watched = {{slope, Eigen::MatrixXd(0, 3 * points)}};
  const auto response = chain.response(options);
  REQUIRE(response.resonances().size() == 6);
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(response.resonances()[i] == Approx(std::sqrt(modes.eigenvalues()[Eigen::Index(i)]) / turn).epsilon(1e-6));
  REQUIRE(response.watched_change().at(0).size() == 2);
  CHECK(response.watched_change()[0][0] <= options.tolerance);
  CHECK(response.watched_change()[0][1] == 0);
  for (std::size_t n = 0; n < response.frequencies().size(); ++n) {
    const auto exact = chain.exact(response.frequencies()[n], options.damping);
    const auto [a, b] = response.at(n);
    const std::complex found(a(0, 31) - a(0, 30), b(0, 31) - b(0, 30));
    CHECK(std::abs(found - (exact[31] - exact[30])) < 1e-3 * exact.cwiseAbs().maxCoeff() / points);
  }
}

TEST_CASE("a harmonic response: too few vectors and loads that move nothing are errors") {
  VaryingChain chain;
  HarmonicOptions options{Sweep{0.01, 0.3, 10}, Damping{1e-6, 0}};
  options.max_vectors = 20;
  CHECK_THROWS_AS(chain.response(options), NumericalError);
  chain.load.setZero();
  CHECK_THROWS_AS(chain.response(options), NumericalError);
}
