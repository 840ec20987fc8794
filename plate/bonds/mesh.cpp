#include "plate/bonds/mesh.hpp"

#include <algorithm>
#include "geometry/lattice/cell_index.hpp"

namespace plate {
namespace {

bool bonded(const geometry::Families& families, std::uint32_t k, std::uint32_t j) {
  return families[k].find(j) < families[k].size();
}

bool all_bonded(const geometry::Families& families, const std::vector<std::uint32_t>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!bonded(families, corners[i], corners[j])) return false;
  return true;
}

/// The quadrilateral of a square of four points, or the triangle of three of them, where bonds join them.
void add_cell(Mesh& mesh, const geometry::Families& families, const geometry::CellIndex& cells,
              const geometry::Point& lower_left) {
  std::vector<std::uint32_t> corners;  // counter-clockwise
  for (const geometry::Point& step : {geometry::Point(0, 0), {1, 0}, {1, 1}, {0, 1}})
    if (const auto corner = cells.at(lower_left + step)) corners.push_back(*corner);
  if (corners.size() == 4 && all_bonded(families, corners)) {
    mesh.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
    return;
  }
  for (std::size_t without = corners.size(); without-- > 0 && corners.size() >= 3;) {
    auto three = corners;
    if (corners.size() == 4) three.erase(three.begin() + std::ptrdiff_t(without));
    if (!all_bonded(families, three)) continue;
    mesh.triangles.push_back({three[0], three[1], three[2]});
    return;
  }
}

}  // namespace

Mesh mesh(const Boundary& boundary, const geometry::Families& families, std::vector<double> cut, double thickness) {
  const std::size_t count = boundary.cloud.plate_points;
  Mesh result;
  result.positions.assign(boundary.cloud.positions.begin(), boundary.cloud.positions.begin() + std::ptrdiff_t(count));
  result.areas.assign(boundary.cloud.areas.begin(), boundary.cloud.areas.begin() + std::ptrdiff_t(count));
  result.cut = std::move(cut);
  result.spacing = boundary.cloud.units.spacing;
  result.thickness = thickness;

  const std::vector<geometry::Point> lattice(boundary.lattice.begin(),
                                             boundary.lattice.begin() + std::ptrdiff_t(count));
  const geometry::CellIndex cells(lattice);
  for (std::uint32_t k = 0; k < count; ++k) {
    add_cell(result, families, cells, lattice[k]);
    // a square whose lower left point is missing belongs to its lower right one
    const geometry::Point left = lattice[k] - geometry::Point(1, 0);
    if (!cells.at(left)) add_cell(result, families, cells, left);
  }
  return result;
}

}  // namespace plate
