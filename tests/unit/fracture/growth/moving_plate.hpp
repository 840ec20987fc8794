#pragma once
#include <sstream>

#include "cases/driver/prepared.hpp"
#include "fracture/growth/moving_bonds_and_tips.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/stretched_motion.hpp"
#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

/// A free square of 20 x 20 points with a crack from its left edge, which edge moments open.
namespace moving_plate {

using fracture::Growth, fracture::MovingGrowth;

inline cases::Case content(Growth::Criterion criterion) {
  auto c = verified_plate::square(0.1);
  c.cracks = {{{-1, 0}, {-0.2, 0}}};
  c.loads = {plate::Load{plate::EdgeMoment{.edges = {"bottom", "top"}, .value = 4}}};
  auto& growth = c.growth.emplace();
  growth.criterion = criterion;
  growth.fracture_energy = 5000;
  growth.direction = Growth::Direction::straight;
  return c;
}

/// The plate; the plate and its plane where loads act there.
struct Motion {
  explicit Motion(cases::Case of) : c(std::move(of)) {}
  cases::Case c;
  plate::Discretised found = cases::discretised({c, {}});
  const plate::Formulation* start = found.plate.get();
  plate::Forces mass = start->mass();
  double time_step = 0.8 * (found.membrane ? plate::stable_time_step(*start, *found.membrane, 1)
                                           : plate::stable_time_step(*start, start->constraints(), mass));

  struct Energies {
    double work = 0, energy = 0;  // since the first instant; strain and kinetic, as central differences count them
  };
  using SaveMotion = std::function<void(const plate::MotionCheckpoint&)>;
  /// Moves up to this step, or on from a memory; `save` sees that before every step.
  Energies move(MovingGrowth& growth, std::size_t steps, const plate::MotionCheckpoint* from = nullptr,
                const SaveMotion& save = {}) const {
    if (!found.membrane)
      return move(growth, growth.plate(), start->constraints(), mass, start->loads(), steps, from, save);
    const plate::StretchedMotion both(*start, *found.membrane, 1,
                                      plate::StretchedMotion::Growing{growth.plate(), *growth.plane()});
    return move(growth, both, both.constraints(), both.mass(), both.loads(), steps, from, save);
  }

private:
  Energies move(MovingGrowth& growth, const plate::Operator& stiffness, const plate::Constraints& constraints,
                const plate::Forces& all_mass, const std::vector<plate::TimedLoad>& loads, std::size_t steps,
                const plate::MotionCheckpoint* from, const SaveMotion& save) const {
    Energies result;
    double first = 0;
    plate::DynamicOptions options;
    options.time_step = time_step, options.steps = steps, options.observe_every = 20;
    options.changes = &growth.changes();
    options.from = from;
    if (save) options.due = [] { return true; }, options.save = save;
    plate::central_differences(stiffness, constraints, all_mass, loads, options, [&](const plate::Instant& now) {
      growth.look(now.time);
      const double energy = now.strain_energy + now.discrete_kinetic_energy;
      if (now.step == 0) first = energy - now.external_work;
      result = {now.external_work, energy - first};
    });
    return result;
  }
};

/// Checkpoint of a growth, restored by another one of the same plate.
inline void hand_over(const MovingGrowth& from, MovingGrowth& to) {
  std::stringstream stream;
  plate::OutArchive out(stream);
  from.save(out);
  plate::InArchive in(stream);
  to.restore(in);
}

}  // namespace moving_plate
