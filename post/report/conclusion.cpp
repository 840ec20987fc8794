#include "post/report/conclusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plate/model/problem.hpp"
#include "plate/solve/statics.hpp"
#include "post/files/summary.hpp"
#include "post/files/table.hpp"
#include "post/report/peaks.hpp"
#include "post/report/reactions.hpp"

namespace post {
namespace {

std::optional<double> largest_deflection(const Table& history) {
  std::optional<double> largest;
  const auto column = history.column("max_abs_w");
  for (const auto& row : history.rows) largest = std::max(largest.value_or(0), std::get<double>(row[column]));
  return largest;
}

void warn_of(const ReactionSummary& reactions, std::vector<std::string>& warnings) {
  constexpr double close = 0.01;
  if (reactions.truncation.value_or(0) > close)
    warnings.push_back(
        fmt::format("reactions are off by about {:.2g} % of the largest, or twice that: a motion needs more Lanczos "
                    "vectors for them than for "
                    "factors and deflections; take a smaller analysis.tolerance, or loads that do not set in at once",
                    100 * *reactions.truncation));
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

void conclude(Summary& summary, Found found) {
  summary.srif = std::move(found.factors);
  if (found.options) summary.toughness = found.options->toughness;
  for (const auto& srif : summary.srif) summary.faces.push_back(at_faces(srif, found.section, summary.toughness));
  summary.reactions = found.reactions.summary();
  if (summary.reactions) warn_of(*summary.reactions, summary.warnings);
  if (const auto w = largest_deflection(found.history)) {
    summary.deflection_over_thickness = *w / found.section.thickness;
    if (found.si && *summary.deflection_over_thickness > small_deflection)
      summary.warnings.push_back(fmt::format(
          "largest deflection is {:.2g} x thickness, {:.3g} m; linear plate theory is reliable up to about {:g} x "
          "thickness; look at units and loads if this is a surprise",
          *summary.deflection_over_thickness, *w, small_deflection));
  }
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
      fmt::format("{} is a single point: deflections grow by {:.1g} % with every halving of the spacing; "
                  "support a part (on) instead",
                  worst, 100 * most)};
}

void look_for_largest(Summary& summary, const plate::Section& section, std::vector<Peak> found,
                      const std::vector<double>& times, const std::vector<std::vector<Srif>>& rows) {
  if (summary.analysis.kind != "dynamic") {
    summary.extremes = std::move(found);
    return;
  }
  summary.peaks = peaks(times, rows, section, summary.toughness);
  for (auto& peak : found) summary.peaks.push_back(std::move(peak));
}

std::vector<std::string> tips_that_grow(const Summary& summary) {
  std::vector<std::string> result;
  const auto say = [&](std::size_t tip, double utilisation, const std::string& when) {
    if (utilisation >= 1)
      result.push_back(fmt::format("tip {}: the equivalent K is {:.3g} times the toughness{}: the crack grows", tip,
                                   utilisation, when));
  };
  for (const auto& peak : summary.peaks)
    if (peak.quantity == "utilisation") say(*peak.tip, peak.value, fmt::format(" at t = {:.4g}", peak.time));
  if (!summary.peaks.empty()) return result;
  for (std::size_t i = 0; i < summary.srif.size(); ++i)
    if (const auto tip = summary.srif[i].tip; i == 0 || summary.srif[i - 1].tip != tip)
      say(tip, summary.faces[i].utilisation.value_or(0), "");
  return result;
}

}  // namespace post
