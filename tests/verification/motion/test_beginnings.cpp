// Motions that begin by themselves, with damping and without, and impacts: one wave of a plate with hard supports moves
// as two degrees of freedom do; a mass hits a plate whose deflection is that of an infinite one for as long as no wave
// is back from its edges.
#include <Eigen/Eigenvalues>
#include <complex>
#include <numbers>

#include "plate/formulation/inertia.hpp"
#include "plate/galerkin/galerkin_plate.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/harmonic.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "plate/solve/motion/lanczos_motion.hpp"
#include "plate/solve/motion/lanczos_space.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/statics.hpp"
#include "post/factors/watched_motion.hpp"
#include "tests/catch.hpp"
#include "tests/verification/at_rest.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;
using geometry::Point, vp::at;

namespace {

const std::vector<const FormulationKind*> both{&galerkin, &ordinary};
const double pi = std::numbers::pi;

cases::Case square(const FormulationKind& kind, int cells) {
  auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 1.0 / cells);
  c.discretization.formulation = &kind;
  c.section = {1000, 0.3, 0.1, 5.0 / 6, 2};
  c.supports = {vp::held_all_round(SupportKind::simply_supported_hard)};
  c.loads.clear();
  return c;
}

/// w = W(t) sin(pi x) sin(pi y), psi = B(t) grad of it: M q'' + (alpha M + beta K) q' + K q = 0 of q = (W, B), by its
/// two modes, from W = B = 1 or with W' = B' = 1.
class Wave {
public:
  Wave(const Section& s, const Damping& damping, bool moves) : damping_(damping), moves_(moves) {
    const double D = s.bending_stiffness(), S = s.shear_stiffness(), L = 2 * pi * pi, rho = s.density, h = s.thickness;
    Eigen::Matrix2d K, M;
    K << S * L, -S * L, -S * L, S * L + D * L * L;
    M << rho * h, 0, 0, rho * h * h * h / 12 * L;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes(K, M);
    squares = modes.eigenvalues(), shapes_ = modes.eigenvectors();
    begin_ = shapes_.transpose() * M * Eigen::Vector2d(1, 1);
  }
  double operator()(double t) const {
    double w = 0;
    for (int i = 0; i < 2; ++i) {
      const double drag = damping_.mass + damping_.stiffness * squares[i];
      const std::complex<double> root = std::sqrt(std::complex<double>(drag * drag / 4 - squares[i], 0));
      const auto slow = std::exp((root - drag / 2) * t), fast = std::exp((-root - drag / 2) * t);
      const auto s = root == 0.0 ? t * slow : (slow - fast) / (2.0 * root);
      const auto y = moves_ ? s : (slow + fast) / 2.0 + drag / 2 * s;
      w += shapes_(0, i) * begin_[i] * y.real();
    }
    return w;
  }
  Eigen::Vector2d squares;

private:
  Damping damping_;
  bool moves_;
  Eigen::Matrix2d shapes_;
  Eigen::Vector2d begin_;
};

struct Motion {
  double off = 0, imbalance = 0;  // root of the mean square of w over the largest; energies that are not accounted for
};

/// By steps, or by Lanczos vectors.
Motion moved(const cases::Case& c, const Wave& wave, double duration, bool by_steps) {
  const auto plate = vp::assembled(c);
  const auto begin = begin_of_motion(*plate, 1);
  double squares = 0, most = 0, count = 0, first = 0;
  Motion result;
  const auto see = [&](const Instant& now) {
    const double w = at(*plate, now.state, {0.5, 0.5}), expected = wave(now.time);
    squares += (w - expected) * (w - expected), most = std::max(most, std::abs(expected)), ++count;
    const double total = now.strain_energy + now.discrete_kinetic_energy + now.dissipated - now.external_work;
    if (now.step == 0) first = total;
    result.imbalance = std::max(result.imbalance, std::abs(total - first) / begin.given);
  };
  if (by_steps) {
    const double free = stable_time_step(*plate, 1);
    const double limit = 0.9 * stable_step(free, *plate, c.analysis, begin);
    const auto steps = std::size_t(std::ceil(duration / limit / 50)) * 50;
    DynamicOptions options{duration / double(steps), steps, steps / 50};
    if (c.analysis.damping)
      options.mass_damping = c.analysis.damping->mass, options.stiffness_damping = c.analysis.damping->stiffness;
    if (begin.deflected.size() > 0) options.start = begin.deflected, options.bent = true;
    options.velocity = begin.velocity, options.given = begin.given;
    central_differences(*plate, plate->constraints(), plate->mass(), plate->loads(), options, see);
  } else {
    auto analysis = c.analysis;
    analysis.duration = duration, analysis.tolerance = 1e-4;
    post::lanczos_motion(analysis, *plate, {}, Eigen::MatrixXd(0, 0), INFINITY, {}).observe(50, see);
  }
  result.off = std::sqrt(squares / count) / most;
  return result;
}

}  // namespace

TEST_CASE("a wave that is let go, or pushed, with three ratios of damping: steps and Lanczos vectors") {
  for (const bool moves : {false, true})
    for (const double ratio : {0.0, 0.02, 0.3})
      for (const bool of_mass : {false, true}) {
        if (ratio == 0 && of_mass) continue;
        auto c = square(galerkin, 24);
        const double omega = std::sqrt(Wave(c.section, {}, false).squares[0]);
        if (ratio > 0) c.analysis.damping = of_mass ? Damping{2 * ratio * omega, 0} : Damping{0, 2 * ratio / omega};
        c.initial.emplace();
        (moves ? c.initial->velocity : c.initial->deflection) = Formula("sin(pi * x) * sin(pi * y)");
        const Wave wave(c.section, c.analysis.damping.value_or(Damping{}), moves);
        const double duration = 3 * 2 * pi / omega;
        for (const auto* kind : both)
          for (const bool by_steps : {true, false}) {
            if (kind == &ordinary && !by_steps) continue;
            c.discretization.formulation = kind;
            const auto found = moved(c, wave, duration, by_steps);
            CAPTURE(kind->name, moves, ratio, of_mass, by_steps, found.off, found.imbalance);
            CHECK(found.off < (kind == &galerkin ? 0.03 : 0.1));
            CHECK(found.imbalance < (by_steps ? 1e-10 : 1e-9));
          }
      }
}

TEST_CASE("a wave of pressure that swings for ever: amplitude and phase at nine frequencies, order of convergence") {
  for (const double thickness : {0.02, 0.1, 0.2}) {
    std::vector<double> off;
    for (const int cells : {12, 24}) {
      auto c = square(galerkin, cells);
      c.section.thickness = thickness;
      const auto& s = c.section;
      const double D = s.bending_stiffness(), S = s.shear_stiffness(), L = 2 * pi * pi, rho = s.density, h = thickness;
      Eigen::Matrix2cd K, M;
      K << S * L, -S * L, -S * L, S * L + D * L * L;
      M << rho * h, 0, 0, rho * h * h * h / 12 * L;
      const double lowest = std::sqrt(Wave(s, {}, false).squares[0]) / (2 * pi);
      c.loads = {Load{Pressure{.formula = Formula("sin(pi * x) * sin(pi * y)")}}};
      const auto plate = vp::assembled(c);
      const auto& constraints = plate->constraints();
      HarmonicOptions options{Sweep{0.2 * lowest, 1.8 * lowest, 9}, Damping{0.1 * lowest, 0.02 / lowest}};
      const HarmonicResponse response(*plate, constraints, plate->inertia(1), plate->loads()[0].forces,
                                      *inverse_of(*plate), options);
      double most = 0;
      for (std::size_t n = 0; n < response.frequencies().size(); ++n) {
        const double omega = 2 * pi * response.frequencies()[n];
        const std::complex drag(1.0, omega * options.damping.stiffness),
            inertia(omega * omega, -omega * options.damping.mass);
        const Eigen::Matrix2cd whole = drag * K - inertia * M;
        const std::complex exact = (whole.inverse() * Eigen::Vector2cd(1, 0))[0];
        const auto [a, b] = response.at(n);
        const std::complex found(at(*plate, a, {0.5, 0.5}), at(*plate, b, {0.5, 0.5}));
        most = std::max(most, std::abs(found - exact) / std::abs(exact));
      }
      off.push_back(most);
    }
    CAPTURE(thickness, off[0], off[1]);
    CHECK(off[1] < 0.05);
    CHECK(off[0] / off[1] > 3);
  }
}

TEST_CASE("a mass that hits a large plate is thrown back as from an infinite one, and the books close") {
  // Zener (1941): y'' + (2 lambda) y' + y = 0 of a linear contact, lambda = sqrt(k m) / (16 sqrt(rho h D)): the force
  // on an infinite thin plate moves it by the integral of the force over 8 sqrt(rho h D)
  for (const auto* kind : both)
    for (const double lambda : {0.1, 0.3}) {
      auto c = vp::free_plate(geometry::rectangle(-1, -1, 1, 1), 0.02);
      c.discretization.formulation = kind;
      c.section = {1000, 0.3, 0.01, 5.0 / 6, 1};
      c.loads.clear();
      const double Z = 8 * std::sqrt(c.section.density * c.section.thickness * c.section.bending_stiffness());
      const double k = 0.02, m = std::pow(2 * lambda * Z, 2) / k, omega = std::sqrt(k / m);
      c.impact = Impact{{0.01, 0.01}, m, -2, k};
      const auto plate = vp::assembled(c);
      const auto begin = begin_of_motion(*plate, 1);
      const double root = std::sqrt(1 - lambda * lambda), end = pi / (omega * root);
      const double step = 0.9 * stable_step(stable_time_step(*plate, 1), *plate, c.analysis, begin);
      const auto steps = std::size_t(std::ceil(1.3 * end / step));
      DynamicOptions options{1.3 * end / double(steps), steps, 4};
      options.impact = begin.impact, options.given = begin.given;
      double after = 0, imbalance = 0, momentum = 0, last = 0;
      const Forces mass = plate->mass();
      central_differences(*plate, plate->constraints(), mass, plate->loads(), options, [&](const Instant& now) {
        after = now.contact_force->velocity;
        if (now.contact_force->force != 0) last = now.time;
        imbalance = std::max(imbalance, std::abs((now.strain_energy + now.kinetic_energy) / begin.given - 1));
        const double all = mass.row(0).dot(now.velocity().row(0)) + m * after;
        momentum = std::max(momentum, std::abs(all / (-2 * m) - 1));
      });
      const double restitution = std::exp(-pi * lambda / root);
      CAPTURE(kind->name, lambda, steps, after / 2, restitution, last / end, imbalance, momentum);
      CHECK(after / 2 == Approx(restitution).epsilon(0.1));
      CHECK(last == Approx(end).epsilon(0.1));
      CHECK(momentum < 1e-9);  // the plate is free
      CHECK(imbalance < 0.02);
    }
}

TEST_CASE("Lanczos vectors of a plate with oblique hard supports stay orthonormal, however many") {
  // rotations follow others there: their rounding grew until the stiffness was not positive
  auto c = square(galerkin, 20);
  c.outline = {{{{-0.1, -0.4}, {0.4, -0.1}, {0.1, 0.4}, {-0.4, 0.1}}, {"e0", "e1", "e2", "e3"}}, {}};
  c.section = {200e9, 0.3, 0.015, 5.0 / 6, 7850};
  c.discretization.spacing = 0.025;
  c.supports = {vp::held(SupportKind::simply_supported_hard, {"e0"}), vp::held(SupportKind::clamped, {"e1"})};
  c.loads = {Load{PointForce{.position = {0.05, 0.02}, .value = 1}}};
  const auto plate = vp::assembled(c);
  const auto inertia = plate->inertia(1);
  const auto inverse = inverse_of(*plate);
  LanczosSpace space(*plate, plate->constraints(), inertia, *inverse);
  CHECK(space.add(plate->total_load()));
  for (Eigen::Index n = 0; n < 400 && n < space.size(); ++n) space.add_after(n);
  REQUIRE(space.size() > 300);
  Eigen::MatrixXd gram(space.size(), space.size());
  for (Eigen::Index i = 0; i < space.size(); ++i)
    gram.col(i) = space.coordinates(Eigen::Map<const State>(space.vectors().col(i).data(), 3, plate->points()));
  CHECK((gram - Eigen::MatrixXd::Identity(space.size(), space.size())).cwiseAbs().maxCoeff() < 1e-12);
}
