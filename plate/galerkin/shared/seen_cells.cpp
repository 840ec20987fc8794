#include "plate/galerkin/shared/seen_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/cells/rows/shared_lattice.hpp"
#include "geometry/lattice/boxes.hpp"
#include "plate/galerkin/shared/part_of_cells.hpp"
#include "plate/model/refused.hpp"

namespace plate {
namespace {

using geometry::CellBox;
using geometry::Point;
using geometry::Tessellation;
using geometry::WholeLattice;

void require_enough(const std::vector<std::size_t>& counts, double spacing, std::size_t points) {
  constexpr std::size_t least = 8;  // points of a process
  if (std::ranges::any_of(counts, [](std::size_t count) { return count < least; }))
    throw Refused({{Subject::spacing, 0,
                    fmt::format("{:g} given makes {} points, in too few rows for {} processes", spacing, points,
                                counts.size())}});
}

std::vector<int> checked_owners(const Tessellation& whole, int processes) {
  auto owners = geometry::shared_out(whole, processes);
  std::vector<std::size_t> counts(std::size_t(processes), 0);
  for (const int owner : owners) ++counts[std::size_t(owner)];
  require_enough(counts, whole.units.spacing, owners.size());
  return owners;
}

geometry::SharedLattice checked_shares(const WholeLattice& whole, int processes) {
  geometry::SharedLattice shares(whole, processes);
  std::vector<std::size_t> counts;
  for (int one = 0; one < processes; ++one) counts.push_back(shares.part(one).points);
  require_enough(counts, whole.units().spacing, whole.size());
  return shares;
}

void extend(CellBox& box, const CellBox& by) {
  for (const std::size_t axis : {0, 1})
    box.low[axis] = std::min(box.low[axis], by.low[axis]), box.high[axis] = std::max(box.high[axis], by.high[axis]);
}

SeenCells all_cells(const Ranks& all, Tessellation whole) {
  SeenCells result;
  result.owners = checked_owners(whole, all.size());
  Point low = Point::Constant(INFINITY), high = -low;
  for (std::size_t k = 0; k < result.owners.size(); ++k)
    if (result.owners[k] == all.rank())
      low = low.cwiseMin(whole.positions[k]), high = high.cwiseMax(whole.positions[k]);
  result.own = geometry::box_between(whole.units, low, high);
  result.cells = std::move(whole);
  return result;
}

/// The cells of own points and those that they see, `inner`, are among those with a place of which all is known; what
/// presses on points of these may be as far beyond as beams have between two places, with two cells to the nearest
/// point.
SeenCells cells_about(const Ranks& all, const Problem& problem, const WholeLattice& whole,
                      const std::vector<geometry::Tip>& tips, const std::optional<CellBox>& besides) {
  constexpr long seen = 8;  // part_of_cells() sees half of that, and what is attached to the last of it
  const auto shares = checked_shares(whole, all.size());
  const auto& units = whole.units();
  const auto& part = shares.part(all.rank());
  SeenCells result;
  result.own = geometry::box_between(units, part.low, part.high);
  auto inner = result.own.grown(seen);
  if (besides) extend(inner, *besides);
  for (const auto& tip : tips) {
    if (!result.own.grown(2).contains(geometry::cell_of(units.to_lattice(tip.position)))) continue;
    const Point reach = Point::Constant(reach_about_tip(problem, tip));
    extend(inner, geometry::box_between(units, tip.position - reach, tip.position + reach).grown(1));
  }
  const auto side = long(std::ceil(whole.longest_side()));
  constexpr long rings = 4;  // of cells about what is wanted; geometry::cells_about() takes three
  const auto about = inner.grown(rings * side + 4);
  auto found = whole.cells_at(about.grown(2 * side + 2));
  result.owners = shares.owners(found);
  result.cells = std::move(found.cells), result.number = std::move(found.number);
  result.cells.window = {about, whole.last()};
  return result;
}

}  // namespace

std::size_t points_of(const WholeCells& whole) {
  if (const auto* lattice = std::get_if<WholeLattice>(&whole)) return lattice->size();
  return std::get<Tessellation>(whole).positions.size();
}

void require_parts(const WholeCells& whole, int processes) {
  if (const auto* lattice = std::get_if<WholeLattice>(&whole))
    checked_shares(*lattice, processes);
  else
    checked_owners(std::get<Tessellation>(whole), processes);
}

SeenCells seen_cells(const Ranks& all, const Problem& problem, WholeCells& whole,
                     const std::vector<geometry::Tip>& tips, const std::optional<CellBox>& besides) {
  if (auto* cells = std::get_if<Tessellation>(&whole)) return all_cells(all, std::move(*cells));
  return cells_about(all, problem, std::get<WholeLattice>(whole), tips, besides);
}

Tessellation about_first_inside(const WholeCells& whole) {
  const auto* lattice = std::get_if<WholeLattice>(&whole);
  const auto first = lattice ? lattice->first_inside() : std::nullopt;
  if (!first) return {};
  const auto [i, j] = *first;
  constexpr long about = 5;
  return lattice->cells_at(CellBox{{i, j}, {i + 1, j + 1}}.grown(about)).cells;
}

}  // namespace plate
