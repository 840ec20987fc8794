#include "plate/model/problem.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/shape/smooth_curve.hpp"

namespace plate {

void join_loads(Problem& problem) {
  for (const auto& one : problem.load_cases)
    problem.loads.insert(problem.loads.end(), one.loads.begin(), one.loads.end());
}

std::optional<std::size_t> resolve_weights(Problem& problem) {
  const auto& section = problem.section;
  for (std::size_t i = 0; i < problem.loads.size(); ++i) {
    auto* pressure = problem.loads[i].as<Pressure>();
    if (!pressure || !pressure->gravity) continue;
    const bool of_plies =
        !section.plies.empty() && std::ranges::all_of(section.plies, [](const Ply& ply) { return bool(ply.density); });
    if (!of_plies && !(section.density > 0)) return i;
    pressure->value = section.mass() * *pressure->gravity;
  }
  return std::nullopt;
}

std::size_t shared_loads(const Problem& problem) {
  std::size_t own = 0;
  for (const auto& one : problem.load_cases) own += one.loads.size();
  return problem.loads.size() - own;
}

std::vector<std::size_t> loads_of(const Problem& problem, std::size_t which) {
  std::vector<std::size_t> result(shared_loads(problem));
  std::iota(result.begin(), result.end(), std::size_t(0));
  std::size_t first = result.size();
  for (std::size_t i = 0; i < which; ++i) first += problem.load_cases[i].loads.size();
  for (std::size_t i = 0; i < problem.load_cases[which].loads.size(); ++i) result.push_back(first + i);
  return result;
}

std::vector<double> factors_of(const Combination& combination, const std::vector<LoadCase>& cases) {
  std::vector<double> result(cases.size(), 0);
  for (const auto& [name, factor] : combination.of) {
    const auto found = std::ranges::find(cases, name, &LoadCase::name);
    result[std::size_t(found - cases.begin())] += factor;
  }
  return result;
}

std::vector<Support> resolved_supports(const Problem& problem) {
  auto supports = problem.supports;
  if (problem.discretization.boundary == EdgeMethod::layer)
    for (auto& support : supports)
      if (support.holds_edges()) support.kind = in_layer(support.kind);
  return supports;
}

std::vector<geometry::CrackPath> crack_paths(const Problem& problem) {
  const double tolerance = geometry::tolerance(problem.outline);
  const auto& d = problem.discretization;
  auto cracks = problem.cracks;
  for (std::size_t i = 0; d.spacing > 0 && i < cracks.size(); ++i)
    cracks[i] = geometry::drawn(problem.cracks, i, tolerance, [&](const geometry::Point& x) {
      const auto& own = problem.cracks[i];
      const double from_end = std::min((x - own.front()).norm(), (x - own.back()).norm());
      return std::min(d.spacing, d.spacing_at_tips() + (d.tip_spacing ? d.spacing_growth * from_end : 0));
    });
  return geometry::crack_paths(problem.outline, cracks, tolerance);
}

}  // namespace plate
