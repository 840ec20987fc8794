#include "post/report/conclusion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/formulation/sections.hpp"
#include "plate/formulation/thermal_curvature.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/analysis.hpp"
#include "plate/solve/motion/dynamics.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/reactions.hpp"
#include "post/report/singular_places.hpp"

namespace post {
namespace {

/// Key of one quantity of one tip.
using Key = std::pair<std::size_t, std::size_t>;  // tip, 0 to 2 of K1 to K3, 3 of the utilisation

void look(std::map<Key, Peak>& found, std::size_t tip, std::size_t quantity, double value, double time) {
  static const std::array names{"K1", "K2", "K3", "utilisation"};
  auto& peak = found.try_emplace({tip, quantity}, Peak{names[quantity], tip, 0, time, {}, {}}).first->second;
  if (std::abs(value) > std::abs(peak.value)) peak.value = value, peak.time = time;
}

void miss(std::map<Key, double>& missed, std::size_t tip, std::size_t quantity, double value) {
  auto& most = missed[{tip, quantity}];
  most = std::max(most, value);
}

}  // namespace

std::vector<Peak> peaks(const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows,
                        const plate::Section& section, std::optional<double> toughness) {
  std::map<Key, Peak> found;
  std::map<Key, double> missed;  // what a value that is not resolved may be
  for (std::size_t n = 0; n < std::min(times.size(), rows.size()); ++n)
    for (const auto* one : recommended(rows[n])) {
      const Srif& srif = *one;
      const std::array values{srif.K1, srif.K2, srif.K3};
      for (std::size_t which = 0; which < 3; ++which)
        if (srif.resolved[which])
          look(found, srif.tip, which, values[which], times[n]);
        else
          miss(missed, srif.tip, which, std::abs(values[which]) + srif.errors[which].value_or(0));
      if (!toughness) continue;
      if (const auto used = at_faces(srif, section, toughness).utilisation)
        look(found, srif.tip, 3, *used, times[n]);
      else
        miss(missed, srif.tip, 3, at_faces(as_resolved(srif), section, toughness).utilisation.value_or(0));
    }
  std::vector<Peak> result;
  for (auto& [key, peak] : found)
    if (const auto more = missed.find(key); more == missed.end() || more->second <= std::abs(peak.value))
      result.push_back(std::move(peak));
  return result;
}

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
  const double away =
      distance_.value_or(std::max(plate_->section().thickness / 2, 4 * plate_->discretization().spacing_at_tips()));
  const auto places = singular_places(*plate_);
  Peak peak{"von_mises", {}, 0, time, {}, {}};
  if (!places.empty()) peak.outside = away;
  const auto change = [&](std::size_t k) {  // half of that to the next points: what a place between them may have more
    double most = 0;
    for (const auto& bond : plate_->families()[k])
      if (bond.neighbour < cloud.plate_points &&
          (cloud.positions[bond.neighbour] - cloud.positions[k]).norm() < 1.5 * plate_->discretization().spacing)
        most = std::max(most, std::abs(resultants.von_mises[bond.neighbour] - resultants.von_mises[Eigen::Index(k)]));
    return most / 2;
  };
  for (std::size_t k = 0; k < cloud.plate_points; ++k) {
    if (!plate_->boundary().owns(k)) continue;
    const double stress = resultants.von_mises[Eigen::Index(k)];
    if (stress <= peak.value && peak.position) continue;
    const auto& x = cloud.positions[k];
    if (std::ranges::any_of(places, [&](const SingularPlace& place) { return (x - place.position).norm() < away; }))
      continue;
    peak.value = stress, peak.position = x, peak.error = change(k);
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
  deflection_.reset(), stress_.reset();
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
  if (stress->position || plate_->distributed()) result.push_back(std::move(*stress));
  return result;
}

namespace {

std::optional<double> largest_deflection(const Table& history) {
  std::optional<double> largest;
  const auto column = history.column("max_abs_w");
  for (const auto& row : history.rows) largest = std::max(largest.value_or(0), std::get<double>(row[column]));
  return largest;
}

void warn_of(const ReactionSummary& reactions, double tolerance, std::vector<std::string>& warnings) {
  constexpr double close = 0.01;
  if (reactions.truncation.value_or(0) > close)
    warnings.push_back(
        fmt::format("reactions are off by about {:.2g} % of the largest, or twice that: too few Lanczos vectors; set "
                    "`tolerance` = {:.2g}",
                    100 * *reactions.truncation, tolerance / 10));
  else if (reactions.largest_residual > close)
    warnings.push_back(
        fmt::format("the reactions balance the loads to {:.2g} % only: do not rely on them more than that",
                    100 * reactions.largest_residual));
}

}  // namespace

void describe(Summary::Analysis& analysis, const std::string& method, const plate::StaticSolution& solution,
              double tolerance) {
  analysis.method = method;
  analysis.iterations = solution.iterations;
  analysis.residual = solution.residual;
  analysis.tolerance = tolerance;
  analysis.stop_reason = solution.stop_reason;
}

std::string error_of_linear_theory(std::optional<double> estimated) {
  constexpr double told = 0.05;
  const double off = estimated.value_or(0);
  if (std::abs(off) < told) return "";
  return fmt::format("linear theory {} deflections by about {:.0f} %", off > 0 ? "overstates" : "understates",
                     100 * std::abs(off));
}

void conclude(Summary& summary, Found found) {
  summary.srif = std::move(found.factors);
  if (found.options) summary.toughness = found.options->toughness;
  for (const auto& srif : summary.srif) summary.faces.push_back(at_faces(srif, found.section, summary.toughness));
  summary.reactions = found.reactions.summary();
  if (summary.reactions) warn_of(*summary.reactions, summary.analysis.tolerance.value_or(0), summary.warnings);
  if (const auto w = largest_deflection(found.history)) {
    summary.deflection_over_thickness = *w / found.section.thickness;
    if (summary.linear_theory_off) {
      if (const auto said = error_of_linear_theory(summary.linear_theory_off); found.si && !said.empty())
        summary.warnings.push_back(said + (found.may_stretch ? "; set `nonlinear` = true" : "; set smaller loads"));
    } else if (found.si && !found.stretches && *summary.deflection_over_thickness > small_deflection) {
      summary.warnings.push_back(fmt::format(
          "largest deflection is {:.2g} x thickness, {:.3g} m; linear plate theory is reliable up to about {:g}; check "
          "units, or set {}",
          *summary.deflection_over_thickness, *w, small_deflection,
          found.may_stretch ? "`nonlinear` = true" : "smaller loads"));
    }
  }
}

std::vector<std::string> unbalanced_hubs(const std::optional<ReactionSummary>& reactions,
                                         const plate::Problem& problem) {
  constexpr double told = 5e-4, wanted = 1e-5;
  if (!reactions || reactions->largest_residual <= told) return {};
  const auto soft = std::ranges::min_element(
      problem.supports, {}, [](const plate::Support& support) { return support.k_w.value_or(INFINITY); });
  if (soft == problem.supports.end() || !soft->k_w) return {};
  return {
      fmt::format("reactions balance the loads to {:.1g} % only: springs of hubs this soft are lost in rounding; set "
                  "k_w = {:.1g} or more in `support {}`",
                  100 * reactions->largest_residual, *soft->k_w * reactions->largest_residual / wanted,
                  soft - problem.supports.begin())};
}

std::vector<std::string> sinking_supports(const std::optional<ReactionSummary>& reactions,
                                          const plate::Problem& problem, double largest) {
  constexpr double told = 0.005, close = 1e-3;  // of the largest deflection; of the plate's size
  if (!reactions || largest == 0) return {};
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const double side = close * (high - low).norm();
  double most = told;
  std::string worst;
  for (std::size_t i = 0; i < reactions->supports.size(); ++i) {
    const auto& [name, position] = reactions->supports[i];
    if (!position || !name.starts_with("pin")) continue;
    const double around = geometry::clipped_cell_area(problem.outline, *position, side) / (side * side);
    const double angle = 2 * std::numbers::pi * std::max(around, 0.1);
    const double sinks = std::abs(reactions->largest[i].force) * std::numbers::ln2 /
                         (angle * problem.section.at(*position).shear_stiffness());
    if (sinks > most * largest) most = sinks / largest, worst = name;
  }
  if (worst.empty()) return {};
  return {
      fmt::format("{} is a single point: deflections grow by {:.1g} % with every halving of the spacing; set "
                  "`support_patch` instead",
                  worst, 100 * most)};
}

void look_for_largest(Summary& summary, const plate::Section& section, std::vector<Peak> found,
                      const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows) {
  if (summary.analysis.kind != plate::Analysis::Kind::dynamic) {
    summary.extremes = std::move(found);
    return;
  }
  summary.peaks = peaks(times, rows, section, summary.toughness);
  for (auto& peak : found) summary.peaks.push_back(std::move(peak));
}

void tell_growth(std::size_t tip, double utilisation, const std::string& when, std::vector<std::string>& warnings) {
  if (utilisation >= 1)
    warnings.push_back(
        fmt::format("tip {}: the equivalent K is {:.3g} times the toughness{}: the crack grows; set loads below "
                    "{:.2g} of these",
                    tip, utilisation, when, 1 / utilisation));
}

std::vector<std::string> tips_that_grow(const Summary& summary) {
  std::vector<std::string> result;
  for (const auto& peak : summary.peaks)
    if (peak.quantity == "utilisation")
      tell_growth(*peak.tip, peak.value, fmt::format(" at t = {:.4g}", peak.time), result);
  if (!summary.peaks.empty()) return result;
  for (std::size_t i = 0; i < summary.srif.size(); ++i)
    if (const auto tip = summary.srif[i].tip; i == 0 || summary.srif[i - 1].tip != tip)
      tell_growth(tip, summary.faces[i].utilisation.value_or(0), "", result);
  return result;
}

}  // namespace post
