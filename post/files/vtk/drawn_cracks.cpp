#include <algorithm>
#include <limits>

#include "post/factors/srif.hpp"
#include "post/files/vtk/crack_lines.hpp"

namespace post {

Cracks given_cracks(const std::vector<geometry::CrackPath>& paths) {
  Cracks result;
  for (const auto& path : paths) result.lines.push_back({path.vertices, std::vector<double>(path.vertices.size(), 0)});
  for (const auto& tip : geometry::tips(paths)) result.tips.push_back({result.tips.size(), tip.crack, tip.position});
  return result;
}

void set_factors(Cracks& cracks, const std::vector<Srif>& factors) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (auto& tip : cracks.tips) {
    const auto found = std::ranges::find(factors, tip.number, &Srif::tip);
    if (found == factors.end()) continue;
    const auto& is = found->resolved;
    tip.factors = {is[0] ? found->K1 : none, is[1] ? found->K2 : none, is[2] ? found->K3 : none};
  }
}

}  // namespace post
