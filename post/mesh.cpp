#include "post/mesh.hpp"

#include "plate/cell_index.hpp"
#include <algorithm>

namespace post {
namespace {

bool bonded(const geometry::Families& families, std::uint32_t k, std::uint32_t j) {
  const auto begin = families.neighbour.begin();
  return std::binary_search(begin + static_cast<std::ptrdiff_t>(families.first[k]),
                            begin + static_cast<std::ptrdiff_t>(families.first[k + 1]), j);
}

bool all_bonded(const geometry::Families& families, const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!bonded(families, corners[i], corners[j])) return false;
  return true;
}

}  // namespace

Mesh mesh(const plate::Boundary& boundary, const geometry::Families& families, std::vector<double> cut,
          double thickness) {
  const std::size_t count = boundary.cloud.plate_points;
  Mesh result;
  result.positions.assign(boundary.cloud.positions.begin(), boundary.cloud.positions.begin() + std::ptrdiff_t(count));
  result.areas.assign(boundary.cloud.areas.begin(), boundary.cloud.areas.begin() + std::ptrdiff_t(count));
  result.cut = std::move(cut);
  result.spacing = boundary.cloud.units.spacing;
  result.thickness = thickness;

  const std::vector<geometry::Point> lattice(boundary.lattice.begin(), boundary.lattice.begin() + std::ptrdiff_t(count));
  const plate::CellIndex cells(lattice);
  for (std::uint32_t k = 0; k < count; ++k) {
    std::vector<std::uint32_t> corners;  // counter-clockwise
    for (const geometry::Point& step : {geometry::Point(0, 0), {1, 0}, {1, 1}, {0, 1}})
      if (const auto corner = cells.at(lattice[k] + step)) corners.push_back(*corner);
    if (corners.size() == 4 && all_bonded(families, corners)) {
      result.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
      continue;
    }
    for (std::size_t without = 0; corners.size() == 4 && without < 4; ++without) {
      auto three = corners;
      three.erase(three.begin() + std::ptrdiff_t(without));
      if (all_bonded(families, three)) {
        result.triangles.push_back({three[0], three[1], three[2]});
        break;
      }
    }
    if (corners.size() == 3 && all_bonded(families, corners)) result.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return result;
}

}  // namespace post
