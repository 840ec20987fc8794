#include "post/report/conclusion.hpp"

#include <algorithm>
#include <cmath>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/heated/heat.hpp"
#include "plate/formulation/resultants.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/motion/dynamics.hpp"

namespace post {
namespace {

using geometry::Point;

/// Where plates have no finite stress.
std::vector<Point> singular(const plate::Formulation& plate) {
  std::vector<Point> result;
  for (const auto& tip : plate.tips()) result.push_back(tip.position);
  for (const auto& holder : plate.boundary().holders)
    if (holder.position) result.push_back(*holder.position);
  for (const auto& load : plate.problem().loads)
    if (load.kind == plate::Load::Kind::point_force && !load.moves()) result.push_back(load.position);
  if (const auto& impact = plate.problem().impact) result.push_back(impact->position);
  for (const auto& spring : plate.problem().springs)
    if (spring.position) result.push_back(*spring.position);
  return result;
}

}  // namespace

void Extremes::row(const plate::Instant& now) {
  for (std::size_t k = 0; k < plate_->cloud().plate_points; ++k) {
    const double w = now.state(0, Eigen::Index(k));
    if (plate_->boundary().owns(k) && (!deflection_ || std::abs(w) > std::abs(deflection_->value)))
      deflection_ = {"w", {}, w, now.time, plate_->cloud().positions[k], {}};
  }
  if (now.strain_energy <= strain_energy_) return;
  strain_energy_ = now.strain_energy, time_ = now.time, state_ = now.state;
}

Peak Extremes::largest_stress(double time, const plate::Resultants& resultants) const {
  const auto& cloud = plate_->cloud();
  const double away = std::max(plate_->section().thickness / 2, 4 * plate_->discretization().spacing_at_tips());
  const auto places = singular(*plate_);
  Peak peak{"von_mises", {}, 0, time, {}, {}};
  if (!places.empty()) peak.outside = away;
  for (std::size_t k = 0; k < cloud.plate_points; ++k) {
    if (!plate_->boundary().owns(k)) continue;
    const double stress = resultants.von_mises[Eigen::Index(k)];
    if (stress <= peak.value && peak.position) continue;
    const auto& x = cloud.positions[k];
    if (std::ranges::any_of(places, [&](const Point& place) { return (x - place).norm() < away; })) continue;
    peak.value = stress, peak.position = x;
  }
  return peak;
}

void Extremes::frame(double time, const plate::Resultants& resultants) {
  seen_ = time;
  auto here = largest_stress(time, resultants);
  if (!stress_ || here.value > stress_->value) stress_ = std::move(here);
}

std::vector<Peak> Extremes::so_far() const {
  std::vector<Peak> result;
  for (const auto& one : {deflection_, stress_})
    if (one) result.push_back(*one);
  return result;
}

void Extremes::so_far(const std::vector<Peak>& peaks) {
  for (const auto& one : peaks) (one.quantity == "w" ? deflection_ : stress_) = one;
}

std::vector<Peak> Extremes::found(const plate::Heat* heat) const {
  std::vector<Peak> result;
  if (!deflection_) return result;
  result.push_back(*deflection_);
  auto stress = stress_;
  if (!stress || seen_ != time_) {
    auto resultants = plate_->resultants(state_);
    plate::relieve(resultants, plate_->section(), heat ? *heat : plate::heat_at(*plate_, time_));
    auto there = largest_stress(time_, resultants);
    if (!stress || there.value > stress->value) stress = std::move(there);
  }
  if (stress->position) result.push_back(std::move(*stress));
  return result;
}

}  // namespace post
