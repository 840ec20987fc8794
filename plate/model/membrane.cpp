#include "plate/model/membrane.hpp"

namespace plate {
namespace {

/// The kind that holds the rotations as a support holds the displacements in the plane. A hub stays one.
SupportKind kind_in_plane(const Support& support) {
  if (support.kind == SupportKind::hub) return SupportKind::hub;
  switch (support.held_in_plane()) {
    case InPlane::fixed:
      return SupportKind::clamped;
    case InPlane::normal:
      return SupportKind::symmetry;
    case InPlane::tangential:
      return SupportKind::simply_supported_hard;
    case InPlane::x:
      return SupportKind::u_alone;
    case InPlane::y:
      return SupportKind::v_alone;
    case InPlane::free:
      break;
  }
  return SupportKind::free;
}

}  // namespace

bool loaded_in_plane(const Problem& problem) {
  return std::ranges::any_of(problem.loads, &Load::in_plane);
}

bool has_plane(const Problem& problem) {
  return problem.stretches || problem.faces_touch() || loaded_in_plane(problem) || problem.coupled();
}

bool rests_with_plane(const Problem& problem) {
  return problem.coupled() || (problem.faces_touch() && (problem.unilateral() || problem.pushed()));
}

std::vector<std::string> warnings_about_axial_stiffness(const Problem& problem) {
  if (has_plane(problem) || std::ranges::none_of(problem.stiffeners, &Stiffener::stretches)) return {};
  return {"axial of stiffeners does nothing, as no load acts in the plane; set eccentricity of ribs on one side"};
}

Problem membrane_of(Problem problem) {
  problem.section.law = PlateLaw::membrane;
  for (auto& support : problem.supports) support.kind = kind_in_plane(support), support.push = Push::both_ways;
  for (auto& load : problem.loads)
    if (auto* heat = load.as<Temperature>(); heat && problem.section.couples())
      std::swap(heat->value, heat->mean), std::swap(heat->formula, heat->mean_formula);
    else if (!load.in_plane())
      load.action = BodyForce{};
    else if (heat)
      heat->value = heat->mean, heat->formula = heat->mean_formula;
  problem.foundations.clear();
  std::erase_if(problem.springs, [](const Spring& spring) { return !spring.stretches(); });
  std::erase_if(problem.stiffeners, [](const Stiffener& beam) { return !beam.stretches(); });
  for (auto& beam : problem.stiffeners) beam.mass = 0;
  return problem;
}

Problem coupling_of(Problem problem) {
  problem.section.law = PlateLaw::coupling;
  problem.foundations.clear();
  std::erase_if(problem.springs, [](const Spring& spring) { return !spring.depth.given(); });
  std::erase_if(problem.stiffeners, [](const Stiffener& beam) { return !beam.eccentric(); });
  return problem;
}

}  // namespace plate
