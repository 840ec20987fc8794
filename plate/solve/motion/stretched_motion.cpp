#include "plate/solve/motion/stretched_motion.hpp"

#include <algorithm>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"

namespace plate {
namespace {

/// Mass of u and v of every point, held or not; none of what stands in the place of w.
Forces mass_in_plane(const Formulation& plate) {
  Forces result = unconstrained_mass(plate, 1);
  result.row(1) = result.row(2) = result.row(0);
  result.row(0).setZero();
  return result;
}

}  // namespace

StretchedMotion::StretchedMotion(const Formulation& plate, const Formulation& membrane, double rotary,
                                 std::optional<Growing> growing)
    : plate_(plate),
      membrane_(membrane),
      growing_(growing),
      unconstrained_mass_(stacked(plate::unconstrained_mass(plate, rotary), mass_in_plane(plate))) {
  if (plate.problem().stretches) stretching_ = membrane.stretching();
  constraints_.add(plate.constraints(), 0);
  constraints_.add(membrane.constraints(), std::uint32_t(plate.points()));
  constraints_.resolve();
  if (!plate.problem().faces_touch()) return;
  pairs_ = plate.face_pairs();
  const Forces mass = this->mass();
  for (const auto& pair : pairs_)
    faces_.push_back(moving_pair(pair, lever_of(pair, plate.sections()), plate.points(), constraints_, mass));
}

StretchedMotion::~StretchedMotion() = default;

std::size_t StretchedMotion::points() const {
  return 2 * plate_.points();
}

void StretchedMotion::internal_force(const State& state, Forces& forces) const {
  const State bending = of_plate(state), membrane = of_plane(state);
  Forces on_bending, on_membrane, stretched;
  (growing_ ? growing_->plate : plate_).internal_force(bending, on_bending);
  if (stretching_)
    stretching_->internal_force(bending, membrane, stretched, on_membrane), on_bending += stretched;
  else
    (growing_ ? growing_->membrane : membrane_).internal_force(membrane, on_membrane);
  forces = stacked(on_bending, on_membrane);
}

void StretchedMotion::absolute_product(const State& state, Forces& forces) const {
  Forces on_bending, on_membrane;
  plate_.absolute_product(of_plate(state), on_bending);
  membrane_.absolute_product(of_plane(state), on_membrane);
  forces = stacked(on_bending, on_membrane);
}

Forces StretchedMotion::diagonal() const {
  return stacked(plate_.diagonal(), membrane_.diagonal());
}

Forces StretchedMotion::mass() const {
  Forces result = unconstrained_mass_;
  constraints_.fold_diagonal(result);
  return result;
}

std::vector<TimedLoad> StretchedMotion::loads() const {
  std::vector<TimedLoad> result = plate_.loads();
  for (std::size_t i = 0; i < result.size(); ++i) {
    auto& load = result[i];
    load.forces = stacked(load.forces, membrane_.loads()[i].forces);
    if (load.lifts()) load.lift = stacked(load.lift, zero_like(load.lift));
  }
  return result;
}

Forces StretchedMotion::load_in_plane(double time) const {
  Forces result = zero_forces(membrane_.points());
  for (const auto& load : membrane_.loads()) result += factor(load.history, time) * load.forces;
  return result;
}

double StretchedMotion::energy_in_plane(const State& state) const {
  const State membrane = of_plane(state);
  if (growing_) return half_work(growing_->membrane, membrane);
  return stretching_ ? stretching_->energies(of_plate(state), membrane).sum() : membrane_.strain_energy(membrane);
}

double StretchedMotion::strain_energy(const State& state) const {
  return plate_.strain_energy(of_plate(state)) + energy_in_plane(state);
}

TouchingFaces StretchedMotion::touching(const std::vector<PairContact>& contacts) const {
  TouchingFaces result;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto& [opening, force] = contacts[i];
    const auto& pair = pairs_[i];
    result.faces.push_back({.position = plate_.cloud().positions[pair.left],
                            .length = pair.length,
                            .opening_top = opening[0],
                            .opening_bottom = opening[1],
                            .force_top = force[0] / pair.length,
                            .force_bottom = force[1] / pair.length});
  }
  return result;
}

State StretchedMotion::at_rest(const Analysis& analysis) const {
  State bending = start_of(plate_, analysis), membrane = start_of(membrane_, analysis);
  if (bending.cols() == 0 && membrane.cols() == 0) return {};
  if (bending.cols() == 0) bending = zero_like(membrane);
  if (membrane.cols() == 0) membrane = zero_like(bending);
  if (!faces_.empty()) {
    const auto touching = touching_faces(plate_, membrane_, {bending, membrane});
    bending += touching.bending, membrane += touching.membrane;
  }
  return stacked(bending, membrane);
}

State StretchedMotion::deflected(const State& bending) const {
  return stacked(bending,
                 stretching_ ? MiddlePlane(membrane_).displacements(bending, zero_like(bending)) : zero_like(bending));
}

double stable_time_step(const Formulation& plate, const Formulation& membrane, double rotary) {
  constexpr double stretching = 0.9;
  Forces mass = mass_in_plane(plate);
  membrane.constraints().fold_diagonal(mass);
  const double limit =
      std::min(stable_time_step(plate, rotary), stable_time_step(membrane, membrane.constraints(), mass));
  return plate.problem().stretches ? stretching * limit : limit;
}

}  // namespace plate
