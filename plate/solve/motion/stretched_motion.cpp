#include "plate/solve/motion/stretched_motion.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/inertia.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/membrane.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/coupled_plate.hpp"
#include "plate/solve/large_deflections.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/plate_in_contact.hpp"
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
      constraints_(stacked(plate.constraints(), membrane.constraints(), plate.points())),
      unconstrained_mass_(stacked(plate::unconstrained_mass(plate, rotary), mass_in_plane(plate))) {
  if (plate.problem().stretches) stretching_ = membrane.stretching();
  if (plate.problem().coupled())
    coupling_ = plate.coupling(), linear_ = CoupledPlate::stiffness(plate, membrane, coupling_);
  if (!plate.problem().faces_touch()) return;
  rows_.emplace(plate);
  faces_ = moving_pairs(*rows_, plate, constraints_, mass());
}

StretchedMotion::~StretchedMotion() = default;

std::size_t StretchedMotion::points() const {
  return 2 * plate_.points();
}

void StretchedMotion::internal_force(const State& state, Forces& forces) const {
  if (linear_ && !stretching_) return linear_->internal_force(state, forces);
  const State bending = of_plate(state), membrane = of_plane(state);
  Forces on_bending, on_membrane, stretched;
  (growing_ ? growing_->plate : plate_).internal_force(bending, on_bending);
  if (stretching_)
    stretching_->internal_force(bending, membrane, stretched, on_membrane), on_bending += stretched;
  else
    (growing_ ? growing_->membrane : membrane_).internal_force(membrane, on_membrane);
  forces = stacked(on_bending, on_membrane);
}

Forces StretchedMotion::on_bending(const State& state) const {
  const State bending = of_plate(state), membrane = of_plane(state);
  Forces result, on_membrane;
  if (stretching_)
    stretching_->internal_force(bending, membrane, result, on_membrane);
  else if (linear_)
    result = -product(coupling_, membrane);
  return result;
}

Stretch StretchedMotion::stretch(const State& bending) const {
  if (stretching_) return stretching_->stretch(bending);
  return {Eigen::Matrix3Xd::Zero(3, bending.cols()), -product(coupling_, bending)};
}

void StretchedMotion::absolute_product(const State& state, Forces& forces) const {
  if (linear_) return linear_->absolute_product(state, forces);
  Forces on_bending, on_membrane;
  plate_.absolute_product(of_plate(state), on_bending);
  membrane_.absolute_product(of_plane(state), on_membrane);
  forces = stacked(on_bending, on_membrane);
}

Forces StretchedMotion::diagonal() const {
  return stacked(plate_.diagonal(), membrane_.diagonal());
}

Forces StretchedMotion::mass() const {
  const Forces plate = of_plate(unconstrained_mass_), membrane = of_plane(unconstrained_mass_);
  Forces result = stacked(plate, zero_like(membrane));
  constraints_.fold_diagonal(result);
  return result + whole_mass(stacked(zero_like(plate), membrane), constraints_);
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
  if (growing_) return half_work(membrane_, growing_->membrane, membrane);
  if (stretching_) return membrane_.sum_of_points(stretching_->energies(of_plate(state), membrane));
  const double alone = membrane_.strain_energy(membrane);
  if (!linear_) return alone;
  return alone + membrane_.sum_of_points(
                     of_plate(state).cwiseProduct(product(coupling_, membrane)).colwise().sum().transpose());
}

double StretchedMotion::coupling_energy(const State& state) const {
  if (!linear_) return 0;
  const State force = on_bending(state), bending = of_plate(state);
  return -plate_.sum_of_points(force.bottomRows(2).cwiseProduct(bending.bottomRows(2)).colwise().sum().transpose());
}

double StretchedMotion::strain_energy(const State& state) const {
  return plate_.strain_energy(of_plate(state)) + energy_in_plane(state);
}

std::vector<char> StretchedMotion::owned() const {
  auto result = plate_.boundary().map.owned;
  result.insert(result.end(), result.begin(), result.end());
  return result;
}

TouchingFaces StretchedMotion::touching(const std::vector<PairContact>& contacts) const {
  const auto count = Eigen::Index(contacts.size());
  Eigen::VectorXd openings(2 * count), forces(2 * count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (const Eigen::Index face : {0, 1}) {
      const auto& [opening, force] = contacts[std::size_t(i)];
      openings[face * count + i] = opening[std::size_t(face)], forces[face * count + i] = force[std::size_t(face)];
    }
  TouchingFaces result;
  if (rows_) result.faces = rows_->contacts(openings, forces);
  return result;
}

State StretchedMotion::at_rest(const Analysis& analysis) const {
  if (rests_with_plane(plate_.problem())) {
    const PlateLoads loads{plate_.first_load(), membrane_.first_load()};
    const State lift = first_lift(plate_);
    const bool nothing = loads.across.isZero(0) && loads.in_plane.isZero(0) && lift.isZero(0);
    if (largest_of(plate_, nothing ? 0 : 1) == 0) return {};
    auto found = CoupledPlate(plate_, membrane_)
                     .equilibrium(loads, {StaticOptions{}.tolerance, analysis.max_iterations, {}}, lift)
                     .of_both;
    if (!found.converged)
      throw NumericalError(
          fmt::format("the plate at the start: {}, residual {:.2e}", found.stop_reason, found.residual));
    return found.state;
  }
  State bending = start_of(plate_, analysis), membrane = start_of(membrane_, analysis);
  if (bending.cols() == 0 && membrane.cols() == 0) return {};
  if (bending.cols() == 0) bending = zero_like(membrane);
  if (membrane.cols() == 0) membrane = zero_like(bending);
  if (!faces_.pairs.empty()) {
    const auto touching = touching_faces(plate_, membrane_, {bending, membrane});
    bending += touching.bending, membrane += touching.membrane;
  }
  return stacked(bending, membrane);
}

State StretchedMotion::deflected(const State& bending) const {
  if (stretching_) return stacked(bending, MiddlePlane(membrane_).displacements(bending, zero_like(bending)));
  if (linear_) return stacked(bending, MiddlePlane(membrane_).solve({-product(coupling_, bending)}).front());
  return stacked(bending, zero_like(bending));
}

double stable_time_step(const Formulation& plate, const Formulation& membrane, double rotary) {
  constexpr double stretching = 0.9;
  const auto of_linear = [&] {
    if (plate.problem().coupled()) {
      const StretchedMotion both(plate, membrane, rotary);
      const auto coupling = plate.coupling();
      const auto& elastic_supports = plate.boundary().elastic_supports;
      const PlateInContact touched(plate, elastic_supports, everywhere(elastic_supports));
      return stable_time_step(*CoupledPlate::stiffness(touched, membrane, coupling), both.constraints(), both.mass());
    }
    const Forces mass = whole_mass(mass_in_plane(plate), membrane.constraints());
    return std::min(stable_time_step(plate, rotary),
                    stable_time_step(membrane, membrane.constraints(), mass, start_by_place(membrane)));
  };
  const double limit = of_linear();
  return plate.problem().stretches ? stretching * limit : limit;
}

double half_work(const Formulation& plate, const Operator& stiffness, const State& state) {
  if (!plate.distributed()) return half_work(stiffness, state);
  Forces forces;
  stiffness.internal_force(state, forces);
  return -plate.sum_of_points(forces.cwiseProduct(state).colwise().sum().transpose()) / 2;
}

}  // namespace plate
