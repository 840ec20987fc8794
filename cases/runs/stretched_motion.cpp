#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "cases/runs/analyses.hpp"
#include "cases/runs/checkpoints.hpp"
#include "cases/runs/results.hpp"
#include "fracture/growth/moving_growth.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/archive.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/motion/stretched_motion.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "post/files/result_checks.hpp"
#include "post/report/terminal.hpp"

namespace cases {
namespace {

/// The growth of a case; null where cracks do not grow.
std::unique_ptr<fracture::MovingGrowth> growth_of(const Case& c, const plate::Formulation& plate,
                                                  const plate::Formulation& membrane) {
  return c.growth ? fracture::moving_growth(*c.growth, plate, c.srif, c.analysis.rotary_inertia, &membrane) : nullptr;
}

/// Stiffness of a plate and its plane whose cracks grow.
std::optional<plate::StretchedMotion::Growing> growing(const fracture::MovingGrowth* growth) {
  return growth ? std::optional<plate::StretchedMotion::Growing>({growth->plate(), *growth->plane()}) : std::nullopt;
}

/// Motion of a plate and its plane by central differences.
class StretchedMotionRun : public AnalysisWithResults {
public:
  StretchedMotionRun(const ValidatedPlate& ready, Outputs& outputs, RunCheckpoints* checkpoints)
      : AnalysisWithResults(ready, outputs),
        membrane_(*ready.membrane),
        growth_(growth_of(content(), plate_, membrane_)),
        both_(plate_, membrane_, content().analysis.rotary_inertia, growing(growth_.get())),
        checkpoints_(checkpoints) {
    if (growth_) results_.grows(*growth_);
  }

  void solve() override;
  void finish() override;

private:
  plate::DynamicOptions options();
  void observe(const plate::Instant& both);
  MembraneResult in_plane(const plate::Instant& both, bool last);
  void conclude(const plate::Instant& both, const plate::Instant& now, bool last);
  void touch(const plate::Instant& both);
  void save(const plate::MotionCheckpoint& now);
  std::optional<plate::MotionCheckpoint> restored();

  const plate::Formulation& membrane_;
  std::unique_ptr<fracture::MovingGrowth> growth_;
  plate::StretchedMotion both_;
  RunCheckpoints* checkpoints_;
  std::vector<double> largest_in_plane_;  // factor of every tip so far
  double largest_rotation_ = 0, largest_pressure_ = 0;
};

/// Options of the motion, but for checkpoints.
plate::DynamicOptions StretchedMotionRun::options() {
  const auto& analysis = content().analysis;
  const auto& [grid, begin] = std::tie(ready_.steps->grid, ready_.begin);
  plate::DynamicOptions result{grid.time_step, grid.steps, grid.steps_per_row};
  result.given = begin.given;
  if (analysis.start == plate::Analysis::Start::equilibrium) result.start = both_.at_rest(analysis);
  if (begin.deflected.size() > 0) {
    result.start = both_.deflected(begin.deflected), result.bent = true;
    result.given += both_.energy_in_plane(result.start);
  }
  if (begin.velocity.size() > 0) result.velocity = plate::stacked(begin.velocity, plate::zero_like(begin.velocity));
  result.impact = begin.impact;
  result.own = both_.owned();
  if (growth_) result.changes = &growth_->changes();
  if (analysis.damping) result.mass_damping = analysis.damping->mass;
  if (plate::has_prescribed_displacements(plate_)) result.unconstrained_mass = both_.unconstrained_mass();
  result.faces = both_.faces();
  if (both_.stretching()) result.strain_energy = [&](const plate::State& state) { return both_.strain_energy(state); };
  return result;
}

/// Finds the results in the plane at an instant. Inertia and damping act as loads there.
MembraneResult StretchedMotionRun::in_plane(const plate::Instant& both, bool last) {
  const plate::State bending = plate::of_plate(both.state), membrane = plate::of_plane(both.state);
  plate::State acceleration = plate::of_plane(both.acceleration());
  if (const auto& damping = content().analysis.damping)
    acceleration += damping->mass * plate::of_plane(both.velocity());
  plate::Forces load = both_.load_in_plane(both.time);
  load -= plate::of_plane(both_.unconstrained_mass()).cwiseProduct(acceleration);
  std::optional<plate::Stretch> stretch;
  if (both_.act_on_each_other()) stretch = both_.stretch(bending), load += stretch->forces;
  MembraneFactorsWanted wanted{content().srif, ready_.membrane_methods, last, &largest_in_plane_};
  std::vector<post::Srif> of_tips;
  if (growth_) of_tips = growth_->factors_in_plane(membrane), wanted.known = &of_tips, wanted.largest = nullptr;
  const auto heat = plate::heat_at(membrane_, both.time);
  auto result = membrane_results(membrane_, membrane, load, heat, wanted, "in the plane", stretch ? &*stretch : nullptr,
                                 growth_ ? growth_->plane() : nullptr);
  if (const auto* stretching = both_.stretching())
    result.forces.moments = result.fields.force = stretching->membrane_forces(bending, membrane);
  if (stretch) couple(result, plate_, membrane_, {bending, membrane}, stretch->strains, heat);
  result.summary.strain_energy = both_.energy_in_plane(both.state) - both_.coupling_energy(both.state) + result.stored;
  result.summary.external_work = both.external_work + result.stored;
  return result;
}

/// Takes a row and perhaps a frame. `both`: of the plate and its plane.
void StretchedMotionRun::observe(const plate::Instant& both) {
  const auto& grid = ready_.steps->grid;
  const bool last = both.step == grid.steps;
  stopwatch().lap("solve");
  const plate::State bending = plate::of_plate(both.state);
  plate::Instant now{.step = both.step,
                     .time = both.time,
                     .state = bending,
                     .velocity = [&] { return plate::of_plate(both.velocity()); },
                     .kinetic_energy = both.kinetic_energy,
                     .external_work = both.external_work,
                     .strain_energy = both.strain_energy,
                     .discrete_kinetic_energy = both.discrete_kinetic_energy,
                     .potential = both.potential,
                     .acceleration = [&] { return plate::of_plate(both.acceleration()); },
                     .interrupted = both.interrupted,
                     .dissipated = both.dissipated,
                     .contact_force = both.contact_force,
                     .faces = both.faces,
                     .contact_so_far = both.contact_so_far};
  plate::Forces on_bending;
  if (both_.act_on_each_other()) on_bending = both_.on_bending(both.state), now.stretched = &on_bending;
  if (both_.stretching())
    largest_rotation_ =
        std::max(largest_rotation_, plate::largest_of(plate_, bending.bottomRows(2).colwise().norm().maxCoeff()));
  if (both.faces) touch(both);
  results_.in_plane(membrane_, in_plane(both, last));
  results_.sample(now, last);
  stopwatch().lap("srif");
  if (last || now.interrupted || now.time >= results_.next_frame() - grid.time_step / 2) results_.frame(now);
  stopwatch().lap("output");
  conclude(both, now, last);
}

/// Takes the contact of crack faces: faces that are closed at tips, the table of this row, and the summary.
void StretchedMotionRun::touch(const plate::Instant& both) {
  const auto found = both_.touching(*both.faces);
  largest_pressure_ = std::max(largest_pressure_, found.largest_force());
  auto said = faces_found(found, plate_);
  said.summary = {both.contact_so_far.least_opening, largest_pressure_, found.closed_share()};
  results_.touching(std::move(said));
}

/// Sets the energies of the summary. At the end, says where nothing has moved.
void StretchedMotionRun::conclude(const plate::Instant& both, const plate::Instant& now, bool last) {
  auto& summary = this->summary();
  summary.analysis.steps = now.step;
  const double stretching = summary.membrane->strain_energy, coupling = both_.coupling_energy(both.state);
  summary.energy = {{"strain", results_.strain_energy()},
                    {"bending", results_.strain_energy() - stretching - coupling},
                    {"stretching", stretching},
                    {"kinetic", now.kinetic_energy},
                    {"external_work", results_.external_work()}};
  if (content().coupled()) summary.energy.emplace_back("coupling", coupling);
  // of beams that act in the plane this would be a part only
  if (std::ranges::none_of(content().stiffeners, &plate::Stiffener::stretches))
    add_elastic_support_energy(plate_, now.state, summary);
  if (content().analysis.damping || now.faces) summary.energy.emplace_back("dissipated", now.dissipated);
  if (now.faces) summary.energy.emplace_back("contact", now.contact_so_far.lost);
  const plate::State membrane = plate::of_plane(both.state);
  if (!last || post::moves(now.state, now.external_work, plate_) || post::moves(membrane, now.external_work, membrane_))
    return;
  const auto& loaded = plate::loaded_in_plane(content()) ? membrane_ : plate_;
  post::require_motion(loaded, post::forces_of(loaded), &loaded == &plate_ ? now.state : membrane, now.external_work,
                       summary.warnings);
}

void StretchedMotionRun::save(const plate::MotionCheckpoint& now) {
  const auto save_state = [&](plate::OutArchive& archive) {
    archive(now, largest_in_plane_, largest_rotation_, largest_pressure_);
    results_.save(archive);
    if (growth_) growth_->save(archive);
  };
  const std::array<plate::State, 4> parts{plate::of_plate(now.state), plate::of_plane(now.state),
                                          plate::of_plate(now.velocity), plate::of_plane(now.velocity)};
  checkpoints_->save(save_state, [&] {
    return own_values(plate_.boundary(), {&parts[0], &parts[1], &parts[2], &parts[3], &results_.state_of_largest()});
  });
}

/// Restores the motion that was found; none where none was.
std::optional<plate::MotionCheckpoint> StretchedMotionRun::restored() {
  plate::MotionCheckpoint result;
  const bool found = checkpoints_->restore([&](plate::InArchive& archive) {
    archive(result, largest_in_plane_, largest_rotation_, largest_pressure_);
    results_.restore(archive);
    if (growth_) growth_->restore(archive);
  });
  if (!found) return std::nullopt;
  std::array<plate::State, 4> parts;
  const auto impose = [](const plate::Formulation& plate) {
    return [&plate](plate::State& state) { plate.constraints().impose(state); };
  };
  const auto impose_and_lift = [&](plate::State& state) {
    plate_.constraints().impose(state);
    if (const auto lift = plate::lift_at(plate_, results_.time_of_largest()); lift.cols() > 0) state += lift;
  };
  const std::vector<RestoredState> states{{&parts[0], impose(plate_)},
                                          {&parts[1], impose(membrane_)},
                                          {&parts[2]},
                                          {&parts[3]},
                                          {&results_.state_of_largest(), impose_and_lift}};
  put_values(plate_.boundary(), checkpoints_->parts(), states);
  result.state = plate::stacked(parts[0], parts[1]), result.velocity = plate::stacked(parts[2], parts[3]);
  return result;
}

void StretchedMotionRun::solve() {
  auto& about = summary().analysis;
  const auto& [limit, grid] = *ready_.steps;
  const double duration = content().analysis.duration;
  about.method = "central_difference";
  about.time_step = grid.time_step, about.time_step_limit = limit, about.duration = duration;
  post::Progress progress(quiet(), "central differences");
  auto options = this->options();
  std::optional<plate::MotionCheckpoint> from;
  if (checkpoints_) {
    options.due = [&] { return plate::largest_of(plate_, checkpoints_->due()) > 0; };
    options.save = [&](const plate::MotionCheckpoint& now) { save(now); };
    if ((from = restored())) options.from = &*from;
  }
  plate::central_differences(both_, both_.constraints(), both_.mass(), both_.loads(), options,
                             [&](const plate::Instant& both) {
                               progress.update(both.time / duration, fmt::format("t = {:.4g}", both.time));
                               observe(both);
                             });
  about.stop_reason = "end of the duration";
}

void StretchedMotionRun::finish() {
  outputs_.warn(warnings_about_rotations(largest_rotation_));
  results_.finish();
}

}  // namespace

std::unique_ptr<PlateAnalysis> stretched_motion(const ValidatedPlate& ready, Outputs& outputs,
                                                RunCheckpoints* checkpoints) {
  return std::make_unique<StretchedMotionRun>(ready, outputs, checkpoints);
}

}  // namespace cases
