// Supports that move in time, in both formulations: a plate on ground that moves as a whole is one at rest under the
// inertia that the ground gives it.

#include "plate/formulation/boundary.hpp"
#include "plate/formulations.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/time_grid.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "post/report/reactions.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace plate;
namespace vp = verified_plate;

namespace {

/// Histories of the place of the ground, and of its inertia and drag by the differences that steps take.
template <typename Place>
std::pair<History, History> histories_of(const Place& at, std::size_t steps, double dt, const Damping& damping) {
  std::pair<History, History> result;
  auto& [ground, inertia] = result;
  ground.kind = inertia.kind = History::Kind::table;
  for (std::size_t n = 0; n <= steps + 1; ++n) {
    const double before = n == 0 ? at(1) : at(n - 1);
    ground.table.emplace_back(double(n) * dt, at(n));
    inertia.table.emplace_back(
        double(n) * dt, -(at(n + 1) - 2 * at(n) + before) / (dt * dt) - damping.mass * (at(n + 1) - before) / (2 * dt));
  }
  return result;
}

}  // namespace

TEST_CASE("a plate on ground that moves is one at rest under its inertia and has the work of its supports") {
  for (const auto* kind : formulations())
    for (const auto& [support, alpha, beta] : {std::tuple(SupportKind::clamped, 0.0, 0.0),
                                               {SupportKind::simply_supported, 0.0, 0.0},
                                               {SupportKind::clamped, 3.0, 1e-3},
                                               {SupportKind::simply_supported, 8.0, 0.0}}) {
      auto c = vp::free_plate(geometry::rectangle(0, 0, 1, 1), 0.1);
      c.discretization.formulation = kind, c.section = vp::section;
      const Load settlement{Settlement{.value = 0.01}};
      const Load pressure{Pressure{.value = vp::section.density * vp::section.thickness * 0.01}};
      c.supports = {vp::held(support, {"left", "right", "bottom", "top"})};
      c.loads = {settlement};
      const Damping damping{alpha, beta};
      const double dt = 0.5 * stable_step(stable_time_step(*vp::assembled(c), 1), damping);
      const auto steps = std::size_t(0.7 / dt);
      const auto at = [&](std::size_t n) { return 1 - std::cos(4 * std::numbers::pi * double(n) * dt); };
      const auto [ground, inertia_of_ground] = histories_of(at, steps, dt, damping);
      c.loads[0].history = ground;
      const auto moving = vp::assembled(c);
      c.loads = {pressure};
      c.loads[0].history = inertia_of_ground;
      const auto resting = vp::assembled(c);
      const auto run = [&](const Formulation& plate, const auto& see) {
        DynamicOptions options;
        options.time_step = dt, options.steps = steps, options.observe_every = 10;
        options.held_forces = true;
        options.mass_damping = damping.mass, options.stiffness_damping = damping.stiffness;
        if (has_prescribed_displacements(plate)) options.unconstrained_mass = unconstrained_mass(plate);
        central_differences(plate, plate.constraints(), plate.mass(), plate.loads(), options, see);
      };
      std::vector<State> states;
      double worst = 0, largest = 0, most_energy = 0, imbalance = 0, balance = 0, dissipated = 0;
      const post::Supports supports(moving->boundary());
      run(*resting, [&](const Instant& now) { states.push_back(now.state); });
      std::size_t row = 0;
      run(*moving, [&](const Instant& now) {
        State relative = now.state;
        const auto plate_points = Eigen::Index(moving->cloud().plate_points);
        relative.row(0).array() -= 0.01 * at(now.step);
        worst = std::max(worst, (relative - states[row]).leftCols(plate_points).cwiseAbs().maxCoeff());
        largest = std::max(largest, states[row++].cwiseAbs().maxCoeff());
        most_energy = std::max(most_energy, now.external_work);
        imbalance = std::max(
            imbalance, std::abs(now.strain_energy + now.discrete_kinetic_energy + now.dissipated - now.external_work));
        CHECK(now.dissipated >= dissipated);
        dissipated = now.dissipated;
        const State with_drag = now.acceleration() + damping.mass * now.velocity();
        const auto inertia = supports.applied(unconstrained_mass(*moving).cwiseProduct(with_drag));
        if (now.step > 0 || damping.none())  // the first half step takes the drag of its end
          balance =
              std::max(balance, supports.balance(*now.held_force, supports.nothing(), &inertia, now.state).residual);
      });
      CAPTURE(kind->name, int(support), alpha, beta, worst / largest, imbalance / most_energy, balance);
      CHECK((dissipated > 0) == !damping.none());
      CHECK(worst < (damping.none() ? 1e-8 : 1e-4) * largest);  // measured, damped: 5e-5, of the first half step
      CHECK(imbalance < 0.01 * most_energy);
      CHECK(balance < 1e-9);
    }
}
