#pragma once
#include <algorithm>
#include <span>

#include "geometry/cells/tessellation.hpp"

namespace geometry {

/// Cells before cracks part them: points at different places, and the pieces of edges and cracks among the sides of
/// cells. In lattice units.
struct Cells {
  std::vector<Point> positions;
  std::vector<Tessellation::Square> squares;
  std::vector<Tessellation::Triangle> triangles;
  std::vector<Curves::Piece> pieces;
};

/// Calls visit(corners) for every cell: a span of points, which may be changed.
template <typename Some, typename Visit>
void for_cells(Some& cells, const Visit& visit) {
  for (auto& square : cells.squares) visit(std::span(square));
  for (auto& triangle : cells.triangles) visit(std::span(triangle));
}

/// Calls visit(k) for the point of every corner of every cell.
template <typename Some, typename Visit>
void for_corners(Some& cells, const Visit& visit) {
  for_cells(cells, [&](const auto& corners) { std::ranges::for_each(corners, visit); });
}

/// Returns the marked points with all points that share a cell with one of them.
template <typename Some>
std::vector<char> grown(const Some& cells, const std::vector<char>& marked) {
  auto result = marked;
  for_cells(cells, [&](const auto& corners) {
    if (std::ranges::any_of(corners, [&](auto k) { return marked[k] != 0; }))
      for (const auto k : corners) result[k] = 1;
  });
  return result;
}

/// Sorts values, of equal ones all but one removed.
void keep_once(auto& values) {
  std::ranges::sort(values);
  const auto again = std::ranges::unique(values);
  values.erase(again.begin(), again.end());
}

/// Centres of the rings of points.
struct RingCentres {
  std::vector<Point> tips;
  std::vector<std::pair<Point, Point>> forces;  // places, and the unit vector that leads away from the next tip
};

/// Triangles all over, of the size that is wanted, in rings about the centres.
Cells graded_cells(const Curves& curves, const Sizing& sizing, const RingCentres& centres);

/// Gives every part of the cells about a point on a curve, as cracks part them, its own point, and leaves out points
/// without cells; returns for every point the one that it comes from.
std::vector<std::uint32_t> part(Cells& cells);

/// Sides of cells that no other cell shares, of cells that are parted so. `origin`: what part() has returned.
std::vector<Tessellation::Border> borders(const Cells& cells, const std::vector<std::uint32_t>& origin);

}  // namespace geometry
