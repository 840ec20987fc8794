#include "plate/model/problem.hpp"

namespace plate {

std::vector<Support> settled_supports(const Problem& problem) {
  auto supports = problem.supports;
  if (problem.discretization.boundary == EdgeMethod::layer)
    for (auto& support : supports)
      if (support.holds_edges()) support.kind = in_layer(support.kind);
  return supports;
}

std::vector<geometry::CrackPath> crack_paths(const Problem& problem) {
  return geometry::crack_paths(problem.outline, problem.cracks, geometry::tolerance(problem.outline));
}

}  // namespace plate
