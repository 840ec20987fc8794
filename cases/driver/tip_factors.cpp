#include "cases/driver/tip_factors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cases/driver/trust.hpp"
#include "post/factors/tip_rings.hpp"

namespace cases {

double clear_distance(const Case& c, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) {
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing);
  double clear = post::clear_distance(c.outline, paths, tip, spacing);
  for (const auto& load : c.loads)
    if (load.kind == plate::Load::Kind::point_force) clear = std::min(clear, (load.position - tip.position).norm());
  for (const auto& support : c.supports)
    for (const auto& point : support.points) clear = std::min(clear, (point - tip.position).norm());
  return clear;
}

double least_clear_distance(const Case& c, const std::vector<geometry::CrackPath>& paths, const std::vector<geometry::Tip>& tips) {
  double result = INFINITY;
  for (const auto& tip : tips) result = std::min(result, clear_distance(c, paths, tip));
  return result;
}

bool ringed(const Case& c, const std::vector<geometry::CrackPath>& paths, const geometry::Tip& tip) {
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing);
  return !post::rings(clear_distance(c, paths, tip), spacing, false).empty();
}

void check_growing_tips(const CaseFile& file, Assembly& assembly) {
  const Case& c = file.content;
  if (!c.growth || c.growth->by_bonds()) return;
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing);
  std::vector<Problem> problems;
  for (const auto& tip : assembly.tips) {
    const double clear = clear_distance(c, assembly.paths, tip);
    if (ringed(c, assembly.paths, tip)) continue;
    const auto why = fmt::format(
        "tip at ({:g}, {:g}): an edge, a load, a pin, another crack or an end of its own leaves {:.3g} "
        "about it, {:.3g} spacings, too little for the energy release rate that growth needs",
        tip.position.x(), tip.position.y(), clear, clear / spacing);
    if (c.analysis.kind == Analysis::Kind::dynamic)
      assembly.warnings.push_back(why + ": it stays where it is");
    else
      problems.push_back({file.place("growth"), "growth", why + "; refine"});
  }
  if (!problems.empty()) throw CaseError(problems);
}

std::vector<post::TipMethods> tip_methods(const CaseFile& file, const Assembly& assembly) {
  const Case& c = file.content;
  std::vector<post::TipMethods> result;
  std::vector<Problem> problems;
  if (!c.srif) return result;
  const auto& cloud = assembly.boundary.cloud;
  const auto* galerkin = assembly.galerkin();
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing);
  const post::BondedPlate plate{galerkin ? galerkin->seen : cloud.positions,
                                cloud.areas,
                                assembly.families(),
                                galerkin ? galerkin->shapes : assembly.ordinary()->shapes(),
                                cloud.plate_points,
                                c.section,
                                spacing,
                                galerkin ? &galerkin->op.families() : nullptr,
                                galerkin ? &galerkin->cells : nullptr};
  const double stairs = 0.75 * error_of_stairs(c, assembly.boundary);  // measured: 91 % of the errors are within the estimates then
  const double narrowest = least_clear_distance(c, assembly.paths, assembly.tips);
  for (const auto& tip : assembly.tips) {
    result.emplace_back(plate, post::TipPlace{tip, assembly.paths[tip.crack], clear_distance(c, assembly.paths, tip), narrowest, stairs},
                        c.discretization.horizon(), *c.srif);
    if (!result.back().works())
      problems.push_back({file.place("srif"), "srif",
                          fmt::format("tip at ({:g}, {:g}): {}", tip.position.x(), tip.position.y(), fmt::join(result.back().left_out(), "; "))});
  }
  if (!problems.empty() && problems.size() == result.size()) throw CaseError(problems);
  return result;
}

void warn_of_ligaments(const Case& c, Assembly& assembly) {
  constexpr double resolved = 2;  // spacings
  const double spacing = c.discretization.tip_spacing.value_or(c.discretization.spacing);
  for (const auto& tip : assembly.tips) {
    const double clear = post::clear_distance(c.outline, assembly.paths, tip, spacing);
    if (clear >= resolved * spacing) continue;
    assembly.warnings.push_back(fmt::format("tip at ({:g}, {:g}): the next edge, crack or bend is {:.2g} spacings away: what lies between is not "
                                            "resolved, and deflections and the factors of all tips may be off by more than is estimated; take "
                                            "discretization.spacing or tip_spacing = {:.2g}",
                                            tip.position.x(), tip.position.y(), clear / spacing, clear / 4));
  }
}

std::vector<std::string> left_out(const Assembly& assembly, const std::vector<post::TipMethods>& methods) {
  std::vector<std::string> result;
  for (std::size_t tip = 0; tip < methods.size(); ++tip) {
    const auto& x = assembly.tips[tip].position;
    if (!methods[tip].works()) {
      result.push_back(fmt::format("tip at ({:g}, {:g}): no intensity factors: {}", x.x(), x.y(), fmt::join(methods[tip].left_out(), "; ")));
      continue;
    }
    for (const auto& reason : methods[tip].left_out())
      result.push_back(fmt::format("tip at ({:g}, {:g}): left out {}", x.x(), x.y(), reason));
  }
  return result;
}

std::vector<post::Srif> srifs(const Case& content, const Assembly& assembly, const std::vector<post::TipMethods>& methods,
                              const plate::State& state, bool all_rings) {
  plate::Forces force;
  if (std::any_of(methods.begin(), methods.end(), [](const auto& tip) { return tip.needs_force(); }))
    assembly.plate().internal_force(state, force);
  std::vector<std::vector<post::Srif>> by_tip(methods.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t tip = 0; tip < methods.size(); ++tip) by_tip[tip] = methods[tip](state, force, all_rings);
  std::vector<post::Srif> result;
  for (std::size_t tip = 0; tip < methods.size(); ++tip)
    for (auto& srif : by_tip[tip]) {
      srif.tip = tip;
      post::normalize(srif, *content.srif, content.section.thickness);
      result.push_back(std::move(srif));
    }
  std::vector<double> largest;
  post::mark_lost(result, content.section.thickness, largest);
  return result;
}

}  // namespace cases
