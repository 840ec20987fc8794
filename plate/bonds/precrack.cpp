#include "plate/bonds/precrack.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Points with a bond that may cross a crack: themselves or an image of theirs within one horizon of it.
std::vector<char> near_cracks(const Boundary& boundary, const std::vector<geometry::CrackPath>& paths, double reach) {
  std::vector<char> near(boundary.lattice.size(), 0);
  const auto close = [&](const Point& u) {
    for (const auto& path : paths)
      if (geometry::distance(path.vertices, u) <= reach) return true;
    return false;
  };
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < near.size(); ++k) near[k] = close(boundary.lattice[k]);
  for (const auto& tie : boundary.constraints.ties())
    if (tie.follower / 3 >= boundary.cloud.plate_points && near[tie.leader / 3]) near[tie.follower / 3] = 1;
  return near;
}

}  // namespace

geometry::Families sever(const Boundary& boundary, const geometry::Families& families,
                         const std::vector<geometry::CrackPath>& paths, double horizon_ratio) {
  if (paths.empty()) return families;
  const auto near = near_cracks(boundary, paths, horizon_ratio);
  return geometry::without(families, [&](std::uint32_t k, std::uint32_t j) {
    if (!near[k] && !near[j]) return false;
    return boundary.any_image(k, j, [&](const Point& p, const Point& q) {
      for (const auto& path : paths)
        if (geometry::severs(path, p, q)) return true;
      return false;
    });
  });
}

std::vector<double> cut_share(const geometry::Families& whole, const geometry::Families& severed,
                              const std::vector<BondShape>& shapes, std::size_t plate_points) {
  std::vector<double> share(plate_points, 0);
  const auto weight = [&](const geometry::Families& families, std::size_t k) {
    double sum = 0;
    for (const auto& bond : families[k]) sum += shapes[bond.vector_id].weight;
    return sum;
  };
  for (std::size_t k = 0; k < plate_points; ++k) {
    const auto before = whole[k].size(), after = severed[k].size();
    if (after < before) share[k] = 1 - weight(severed, k) / weight(whole, k);
  }
  return share;
}

}  // namespace plate
