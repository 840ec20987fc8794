#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/cells/graded_points.hpp"
#include "geometry/cells/untied_cells.hpp"

namespace geometry {
namespace {

TriangleMesh filled(const Curves& curves, const Sizing& sizing, const RingCentres& centres) {
  TriangleMesh mesh(curves);
  add_rings(mesh, curves, sizing, centres.tips);
  for (const auto& [place, away] : centres.forces) add_rings(mesh, sizing, place, away);
  add_rows(mesh, sizing);
  refine(mesh, sizing);
  smooth(mesh, curves, sizing);
  return mesh;
}

/// By strips one spacing high, so that neighbours are near in memory.
std::vector<std::uint32_t> in_strips(const std::vector<Point>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Point &x = points[a], &y = points[b];
    const double strip = std::floor(x.y()), other = std::floor(y.y());
    return strip != other ? strip < other : x.x() != y.x() ? x.x() < y.x() : x.y() < y.y();
  });
  return order;
}

}  // namespace

Cells graded_cells(const Curves& curves, const Sizing& sizing, const RingCentres& centres) {
  const auto mesh = filled(curves, sizing, centres);
  const auto order = in_strips(mesh.points());
  std::vector<std::uint32_t> index(order.size());
  Cells result;
  for (std::uint32_t i = 0; i < order.size(); ++i)
    index[order[i]] = i, result.positions.push_back(mesh.points()[order[i]]);
  for (const auto& triangle : mesh.triangles()) {
    if (!triangle.inside) continue;
    const auto& [a, b, c] = triangle.corner;
    result.triangles.push_back({index[a], index[b], index[c]});
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = triangle.corner[(i + 1) % 3], to = triangle.corner[(i + 2) % 3];
      // a piece of a crack has two triangles
      if (triangle.mark[i] >= 0 || (triangle.mark[i] == Curves::crack && from < to))
        result.pieces.push_back({index[from], index[to], triangle.mark[i]});
    }
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

}  // namespace geometry
