#include "plate/bonds/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include "geometry/cells/drawn_cells.hpp"
#include "plate/formulation/interpolation.hpp"

namespace plate {
namespace {

/// Weights of the points that a corner sees. Points on one line, or nearly, extend no linear field across it: then the
/// mean.
Mesh::Corner corner(const geometry::DrawnCells::Corner& from, const Boundary& boundary) {
  constexpr double largest = 3;  // weight; beside a straight edge 1.5
  const geometry::Point at = boundary.cloud.units.to_units(from.position);
  std::vector<std::pair<std::uint32_t, geometry::Point>> near;
  for (const auto k : from.seen) near.emplace_back(k, boundary.lattice[k]);
  Mesh::Corner result{from.position, {}};
  double sum = 0, linear = 0;
  for (const auto& share : interpolation(near, at)) {
    const double mean = 1 / ((boundary.lattice[share.point] - at).squaredNorm() + 1e-6);
    result.sources.push_back({share.point, share.weight, mean});
    sum += mean, linear += share.weight;
  }
  for (auto& source : result.sources) source.mean /= sum;
  const auto is_large = [](const Mesh::Source& source) { return std::abs(source.linear) > largest; };
  if (std::abs(linear - 1) > 1e-6 || std::ranges::any_of(result.sources, is_large))
    for (auto& source : result.sources) source.linear = source.mean;
  return result;
}

}  // namespace

Mesh mesh(const Boundary& boundary, const geometry::Outline& outline, const std::vector<geometry::CrackPath>& cracks,
          std::vector<double> cut, double thickness) {
  const auto count = std::ptrdiff_t(boundary.cloud.plate_points);
  const auto& [units, positions, areas, plate_points, part] = boundary.cloud;
  Mesh result{{positions.begin(), positions.begin() + count},
              {areas.begin(), areas.begin() + count},
              std::move(cut),
              {},
              {},
              units.spacing,
              thickness};
  try {
    auto cells =
        geometry::drawn_cells(outline, cracks, units, {boundary.lattice.begin(), boundary.lattice.begin() + count});
    for (const auto& one : cells.corners) result.corners.push_back(corner(one, boundary));
    result.quads = std::move(cells.squares), result.triangles = std::move(cells.triangles);
  } catch (const std::logic_error&) {  // no cells can be drawn: the mesh has points alone
    result.corners.clear();
  }
  return result;
}

}  // namespace plate
