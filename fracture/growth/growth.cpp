#include "fracture/growth/growth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "post/factors/plate_factors.hpp"

namespace fracture {

std::string in_words(const Ended& ended, bool by_bonds) {
  using enum End;
  switch (ended.how) {
    case no_tip_left:
      return "no tip is left";
    case cannot_grow:
      return by_bonds ? "no bond can break" : "no tip can grow";
    case no_growth:
      return by_bonds ? "no bond breaks under the whole load" : "no growth under the whole load";
    case arrested:
      return "arrested under the whole load";
    case most_advances:
      return "the largest number of advances";
    case longest:
      return by_bonds ? "the largest length of cracks" : "the largest length of a crack";
    case unstable:
      return by_bonds ? "the next bond breaks unstably" : "the next advance is unstable";
    case not_resolved:
      return "stopped: not resolved: " + ended.detail;
    case split:
      return "the plate split: " + ended.detail;
    case interrupted:
      return "interrupted";
    case failed:
      return "failed: " + ended.detail;
  }
  return "";
}

std::string in_words(const MovingGrowthOutcome& outcome) {
  std::string result;
  if (outcome.broken)
    result = *outcome.broken == 0 ? "no bond broke" : fmt::format("{} bonds broken", *outcome.broken);
  else if (outcome.advances == 0 && outcome.under_way > 0)
    result = fmt::format("{} pieces of crack have begun, none has ended", outcome.under_way);
  else
    result = outcome.advances == 0 ? "no growth" : fmt::format("{} pieces of crack", outcome.advances);
  if (!outcome.reached.empty()) result += fmt::format(", {} reached", fmt::join(outcome.reached, ", "));
  for (const auto* stopped : {&outcome.stopped, &outcome.unsteady})
    if (!stopped->empty()) result += fmt::format("; stopped: not resolved: {}", fmt::join(*stopped, "; "));
  if (outcome.parts > outcome.parts_before)
    result += fmt::format("; the plate split in {} parts{}", outcome.parts, outcome.frozen ? "" : ", which move on");
  return result;
}

namespace {

/// The first crack that runs through points of a plate. Collective.
std::optional<std::size_t> crack_through_points(const plate::Formulation& plate) {
  constexpr double nothing = 1e-6;  // spacings
  const auto& cracks = plate.problem().cracks;
  const auto& cloud = plate.cloud();
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    const auto end = cloud.positions.begin() + std::ptrdiff_t(cloud.plate_points);
    const bool found = std::any_of(cloud.positions.begin(), end, [&](const auto& x) {
      return geometry::distance(cracks[i], x) < nothing * cloud.units.spacing;
    });
    if (plate::largest_of(plate, found ? 1 : 0) > 0) return i;
  }
  return std::nullopt;
}

/// Spacing of one point more across the plate: a line between its points no longer meets them.
double spacing_beside(const plate::Problem& problem) {
  const auto [low, high] = geometry::bounding_box(problem.outline);
  const double side = (high - low).minCoeff();
  return side / (std::round(side / problem.discretization.spacing) + 1);
}

}  // namespace

std::vector<std::string> warnings_about_bonds(const Growth& growth, const plate::Formulation& plate) {
  std::vector<std::string> warnings;
  if (const auto crack = plate.breaking() ? crack_through_points(plate) : std::nullopt)
    warnings.push_back(
        fmt::format("crack {} runs through points, which all count to one side: mirrored cracks grow "
                    "unlike; set `spacing` = {:.4g}",
                    *crack, spacing_beside(plate.problem())));
  if (!growth.by_bonds()) return warnings;
  const double h = plate.section().thickness / plate.discretization().spacing, m = plate.discretization().horizon_ratio;
  const bool curvature = growth.criterion == Growth::Criterion::curvature_shear;
  const bool measured =
      curvature ? h >= 1.2 && h <= 15 && m >= 3 && m <= 3.1 : h >= 0.4 && h <= 50 && m >= 2.9 && m <= 5.1;
  if (!growth.apparent_toughness && growth.fracture_energy > 0 && (!measured || plate.section().poisson < 0))
    warnings.push_back(fmt::format(
        "apparent toughness of bonds was not measured at a thickness of {:.3g} spacings, a horizon of {:.3g} spacings "
        "and Poisson's ratio {:g}; set `apparent_toughness`",
        h, m, plate.section().poisson));
  if (std::ranges::any_of(plate.boundary().sides,
                          [](const auto& side) { return side.kind == plate::SupportKind::symmetry; }))
    warnings.push_back(
        "bonds across a line of symmetry do not break: no crack crosses it; set the whole outline instead");
  return warnings;
}

std::vector<std::string> tips_without_rings(const plate::Formulation& plate) {
  const auto& problem = plate.problem();
  std::vector<std::string> result;
  for (const auto& tip : plate.tips()) {
    if (post::ringed(problem, plate.paths(), tip)) continue;
    const double clear = post::clear_distance(problem, plate.paths(), tip);
    result.push_back(
        fmt::format("tip at ({:g}, {:g}): {:.3g} spacings of room are too little for an energy release rate; set "
                    "{} = {:.2g}",
                    tip.position.x(), tip.position.y(), clear / problem.discretization.spacing_at_tips(),
                    plate.offers(plate::Feature::graded_points) ? "`tip_spacing`" : "`spacing`", clear / 5));
  }
  return result;
}

std::vector<std::string> warnings_about_spent_energy(const Growth& growth, const MovingGrowthOutcome& outcome,
                                                     const plate::Section& section, const std::string& remedy) {
  constexpr double band = 0.05, fast = 0.83;  // nine tenths of the largest speed
  if (growth.by_bonds() || !outcome.spent || std::abs(*outcome.spent - 1) <= band) return {};
  const double speed = outcome.largest_speed / section.shear_wave_speed();
  return {*outcome.spent > 1 && speed > fast
              ? fmt::format("tips took {:.2f} times the fracture energy at up to {:.2f} of the speed of shear waves: a "
                            "crack would branch; set `criterion` = \"bond_energy\"",
                            *outcome.spent, speed)
              : fmt::format("tips took {:.2f} times the fracture energy over {} pieces of crack: their speed is not "
                            "resolved; {}",
                            *outcome.spent, outcome.advances, remedy)};
}

std::vector<std::string> warnings_about_directions(const MovingGrowthOutcome& outcome, const std::string& remedy) {
  std::vector<std::string> result;
  if (outcome.direction_unknown)
    result.push_back("directions of tips are not known within 30 degrees: they went straight on; " + remedy);
  for (const auto& stopped : outcome.stopped)
    result.push_back(fmt::format("{}: it stopped there; set `direction` = \"straight\"", stopped));
  for (const auto& unsteady : outcome.unsteady)
    result.push_back(fmt::format("{}: it stopped there; {}", unsteady, remedy));
  return result;
}

}  // namespace fracture
