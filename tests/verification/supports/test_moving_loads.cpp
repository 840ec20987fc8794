// Loads that move along paths, in both formulations, against the double series of the plate of Mindlin with hard
// supports: every wave has two motions, of bending and of thickness shear.
#include <Eigen/Eigenvalues>

#include "plate/formulation/interpolation.hpp"
#include "plate/formulations.hpp"
#include "plate/solve/motion/dynamics.hpp"
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
