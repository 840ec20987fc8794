#include "post/files/result_checks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/reduction.hpp"
#include "plate/solve/prescribed_displacements.hpp"
#include "plate/solve/statics.hpp"
#include "plate/solve/validation.hpp"
#include "post/factors/srif.hpp"

namespace post {
bool is_zero(const plate::State& values, const plate::Formulation& plate) {
  return plate::largest_of(plate, values.isZero(0) ? 0 : 1) == 0;
}

void require_finite(const Named& numbers, const std::string& when) {
  for (const auto& [name, value] : numbers)
    if (!std::isfinite(value))
      throw plate::NumericalError(
          fmt::format("{} is {} {}: the numbers are beyond what double precision holds", name, value, when));
}

void require_finite(const std::vector<Srif>& factors, const std::string& when) {
  for (const auto& one : factors) {
    const auto at = fmt::format("by {} at the tip at ({:g}, {:g}) {}", name_of(one.method), one.position.x(),
                                one.position.y(), when);
    require_finite({{"K1", one.K1}, {"K2", one.K2}, {"K3", one.K3}, {"G", one.G.value_or(0)}}, at);
  }
}

void require_finite(const plate::State& state, const std::string& when, const plate::Formulation& plate) {
  plate::require_finite(state, when, plate.constraints());
  if (!std::isfinite(state.cwiseAbs().sum()))
    throw plate::NumericalError(fmt::format("the displacements are too large for double precision {}", when));
}

namespace {

/// `strained`: the state less what moves it as one rigid body.
double work_of_all(const plate::Formulation& plate, const plate::State& state, const plate::State& strained) {
  double work = 0;
  for (const auto& load : plate.loads()) work += slow_work(plate, load.forces, state);
  if (!plate::has_prescribed_displacements(plate)) return work;
  return work + plate::PrescribedDisplacements(plate, plate.total_load(), plate::total_lift(plate)).work(strained);
}

}  // namespace

double slow_work(const plate::Formulation& plate, const plate::State& state) {
  return work_of_all(plate, state, state);
}

double slow_work(const plate::Formulation& plate, const plate::StaticResult& result) {
  return work_of_all(plate, result.solution.state, result.what_strains());
}

double energy_about(const plate::Formulation& plate, const plate::State& lift) {
  return lift.cols() == 0 ? 0 : plate.strain_energy(lift);
}

double energy_about(const plate::Formulation& plate) {
  return energy_about(plate, plate::total_lift(plate));
}

double slow_work(const plate::Formulation& plate, const plate::Forces& load, const plate::State& state) {
  const auto of_point = [&](std::size_t k) {
    const bool counts = plate.boundary().owns(k);
    return std::array<double, 1>{counts ? load.col(Eigen::Index(k)).dot(state.col(Eigen::Index(k))) : 0};
  };
  return plate::ordered_sum<1>(plate, std::size_t(state.cols()), of_point)[0] / 2;
}

std::vector<plate::Forces> forces_of(const plate::Formulation& plate) {
  std::vector<plate::Forces> result;
  for (const auto& load : plate.loads()) {
    const auto* moving = load.moving ? &load.moving->stations : nullptr;
    if (moving)  // half way
      result.push_back(load.moving->whole((*moving)[moving->size() / 2].time, plate.points()));
    else
      result.push_back(plate::PrescribedDisplacements(plate, load.forces, load.lift).pull());
  }
  return result;
}

bool moves(const plate::State& state, double work, const plate::Formulation& plate) {
  constexpr double least = std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
  return !is_zero(state, plate) && std::abs(work) >= least;
}

void require_motion(const plate::Formulation& plate, const std::vector<plate::Forces>& loads, const plate::State& state,
                    double work, std::vector<std::string>& warnings) {
  const auto& constraints = plate.constraints();
  const bool loaded = std::ranges::any_of(loads, [&](plate::Forces load) {
    constraints.fold(load);
    return !is_zero(load, plate);
  });
  if (!loaded) {
    warnings.emplace_back("no load reaches a part of the plate that may move: it stays as it is");
    return;
  }
  if (is_zero(state, plate) && plate::cancel(plate, loads)) {
    warnings.emplace_back("the loads cancel: the plate stays at rest");
    return;
  }
  if (is_zero(state, plate))
    throw plate::NumericalError(
        "nothing has moved although loads act: numbers are too small for double precision, or no load acts at any "
        "step");
  if (!plate::has_prescribed_displacements(plate) && !moves(state, work, plate))
    throw plate::NumericalError(fmt::format(
        "the loads do a work of {:g}: numbers are too small for double precision; choose other units", work));
}

void EnergyBalance::check(const Terms& now, const std::string& when) {
  constexpr double allowed = 0.01, rounding = 1e-9;
  constexpr double much = 4;  // near the stable step, energies of full steps are up to 2.8 times those that are kept
  if (!before_) before_ = plate_ == Plate::rests ? 0 : now.discrete - now.work;
  largest_work_ = std::max(largest_work_, std::abs(now.work));
  const double beyond = std::abs(now.discrete - now.work - *before_);
  const bool open = plate_ != Plate::grows && beyond > allowed * largest_work_ && beyond > rounding * now.energy;
  if (open || last_energy_ > much * largest_work_)
    throw plate::NumericalError(
        fmt::format("the plate has an energy of {:g} {}, but the loads have done a work of {:g}: the numbers are wrong",
                    now.energy, when, now.work));
  last_energy_ = now.energy;
}

}  // namespace post
