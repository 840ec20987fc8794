#include <algorithm>
#include <numeric>

#include "geometry/cells.hpp"
#include "geometry/delaunay.hpp"

namespace geometry {

Cells graded_cells(const Curves& curves, const Sizing& sizing) {
  auto found = refined_delaunay(curves, sizing);
  // numbered by strips one spacing high, so that neighbours are near in memory
  std::vector<std::uint32_t> order(found.points.size()), index(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Point &x = found.points[a], &y = found.points[b];
    const double strip = std::floor(x.y()), other = std::floor(y.y());
    return strip != other ? strip < other : x.x() != y.x() ? x.x() < y.x() : x.y() < y.y();
  });
  Cells result;
  for (std::uint32_t i = 0; i < order.size(); ++i)
    index[order[i]] = i, result.positions.push_back(found.points[order[i]]);
  for (const auto& [a, b, c] : found.triangles) result.triangles.push_back({index[a], index[b], index[c]});
  std::sort(result.triangles.begin(), result.triangles.end());
  for (const auto& piece : found.pieces) result.pieces.push_back({index[piece.from], index[piece.to], piece.edge});
  return result;
}

}  // namespace geometry
