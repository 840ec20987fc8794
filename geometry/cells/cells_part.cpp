#include "geometry/cells/cells_part.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/cells/uncracked_cells.hpp"

namespace geometry {
namespace {

double off(std::size_t cut, std::size_t wanted) {
  return std::abs(double(cut) - double(wanted));
}

/// Index nearest to `wanted` at which the points, sorted along the axis, may be divided. Where there is none: `wanted`
/// itself; along x the number of points.
std::size_t nearest_cut(std::span<std::uint32_t> points, const Tessellation& cells, Eigen::Index axis,
                        std::size_t wanted) {
  const auto& x = cells.positions;
  std::ranges::sort(points, {}, [&](std::uint32_t k) { return std::tuple(x[k][axis], x[k][1 - axis], k); });
  const auto parts = [&](std::size_t i) {
    const auto k = points[i], before = points[i - 1];
    if (axis == 0 && !cells.graded) return column_block_of(cells, k) != column_block_of(cells, before);
    return x[k][axis] != x[before][axis];
  };
  for (std::size_t away = 0; away < points.size(); ++away) {
    if (wanted > away && parts(wanted - away)) return wanted - away;
    if (wanted + away > 0 && wanted + away < points.size() && parts(wanted + away)) return wanted + away;
  }
  return axis == 0 ? points.size() : wanted;
}

/// Sorts the points, and says how many are of the lower share.
std::size_t halved(std::span<std::uint32_t> points, const Tessellation& cells, double share) {
  constexpr double of_rows = 1.5, most = 0.1;  // rows of points are long: forces are fastest along them
  const auto& x = cells.positions;
  Point low = x[points[0]], high = low;
  for (const auto k : points) low = low.cwiseMin(x[k]), high = high.cwiseMax(x[k]);
  const auto wanted = std::size_t(double(points.size()) * share + 0.5);
  if ((high - low).x() > of_rows * (high - low).y())
    if (const auto cut = nearest_cut(points, cells, 0, wanted); off(cut, wanted) <= most * double(points.size()))
      return cut;
  return nearest_cut(points, cells, 1, wanted);
}

void share_out(std::span<std::uint32_t> points, const Tessellation& cells, int first, int parts,
               std::vector<int>& owners) {
  if (parts == 1 || points.empty()) {
    for (const auto k : points) owners[k] = first;
    return;
  }
  const int lower = parts / 2;
  const auto cut = halved(points, cells, double(lower) / parts);
  share_out(points.first(cut), cells, first, lower, owners);
  share_out(points.subspan(cut), cells, first + lower, parts - lower, owners);
}

}  // namespace

CellsPart cells_about(const Tessellation& whole, std::vector<char> wanted) {
  for (int ring = 0; ring < 2; ++ring) wanted = grown(whole, wanted);
  const auto taken = grown(whole, wanted);  // every point has a cell
  CellsPart result{{whole.units, whole.graded, {}, {}, {}, {}, whole.names, {}}, {}};
  auto& part = result.cells;
  std::vector<std::uint32_t> place(wanted.size(), 0);
  for (std::uint32_t k = 0; k < taken.size(); ++k) {
    if (!taken[k]) continue;
    place[k] = std::uint32_t(result.number.size());
    result.number.push_back(k);
    part.positions.push_back(whole.positions[k]), part.local.push_back(whole.local[k]);
  }
  const auto take = [&](auto cell, auto& cells) {
    if (std::ranges::none_of(cell, [&](auto k) { return wanted[k] != 0; })) return;
    for (auto& k : cell) k = place[k];
    cells.push_back(cell);
  };
  for (const auto& square : whole.squares) take(square, part.squares);
  for (const auto& triangle : whole.triangles) take(triangle, part.triangles);
  for (const auto& [from, to, edge] : whole.borders)
    if (taken[from] && taken[to]) part.borders.push_back({place[from], place[to], edge});
  return result;
}

long column_block_at(double x, double spacing) {
  return std::lround(std::floor(std::round(x / spacing) / double(columns_per_block)));
}

long column_block_of(const Tessellation& cells, std::size_t k) {
  return column_block_at(cells.local[k].x(), cells.units.spacing);
}

std::vector<int> shared_out(const Tessellation& cells, int parts) {
  std::vector<std::uint32_t> points(cells.positions.size());
  std::iota(points.begin(), points.end(), 0);
  std::vector<int> owners(points.size(), 0);
  share_out(points, cells, 0, parts, owners);
  return owners;
}

}  // namespace geometry
