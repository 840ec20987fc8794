#include "plate/model/problem.hpp"

namespace plate {

std::vector<geometry::CrackPath> crack_paths(const Problem& problem) {
  return geometry::crack_paths(problem.outline, problem.cracks, geometry::tolerance(problem.outline));
}

}  // namespace plate
