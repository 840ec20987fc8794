#include "plate/galerkin/shared/foretold_parts.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cells/rows/shared_lattice.hpp"
#include "geometry/lattice/boxes.hpp"
#include "plate/galerkin/shared/laid_out.hpp"
#include "plate/galerkin/shared/part_of_cells.hpp"
#include "plate/galerkin/shared/seen_cells.hpp"
#include "plate/model/problem.hpp"

namespace plate {
namespace {

using geometry::CellBox;
using geometry::Point;

/// A plate and its shares, where points are counted by boxes of cells.
struct Shares {
  geometry::LatticeUnits units;
  std::vector<double> points;  // of every process
  std::vector<CellBox> boxes;  // about these
  std::function<double(const CellBox&)> count;
  bool whole = false;
};

Shares shares_of(const geometry::WholeLattice& lattice, int processes) {
  const geometry::SharedLattice shared(lattice, processes);
  Shares result{lattice.units(), {}, {}, {}, false};
  for (int one = 0; one < processes; ++one) {
    const auto& part = shared.part(one);
    result.points.push_back(double(part.points));
    result.boxes.push_back(geometry::box_between(lattice.units(), part.low, part.high));
  }
  result.count = [&lattice](const CellBox& box) {
    double found = 0;
    for (long j = std::max(0L, box.low[1]); j < std::min(box.high[1], lattice.points().rows()); ++j)
      for (const auto& run : lattice.points().row(j))
        found += double(std::max(0L, std::min<long>(run.to, box.high[0]) - std::max<long>(run.from, box.low[0])));
    for (const auto& x : lattice.others()) found += box.contains(geometry::cell_of(x));
    return found;
  };
  return result;
}

Shares shares_of(const geometry::Tessellation& cells, int processes) {
  const auto owners = geometry::shared_out(cells, processes);
  Shares result{cells.units, std::vector<double>(std::size_t(processes), 0), {}, {}, true};
  std::vector<Point> low(result.points.size(), Point::Constant(INFINITY)), high(low.size(), -low.front());
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const auto one = std::size_t(owners[k]);
    ++result.points[one];
    low[one] = low[one].cwiseMin(cells.positions[k]), high[one] = high[one].cwiseMax(cells.positions[k]);
  }
  for (std::size_t one = 0; one < low.size(); ++one)
    result.boxes.push_back(geometry::box_between(cells.units, low[one], high[one]));
  result.count = [&cells](const CellBox& box) {
    return double(std::ranges::count_if(
        cells.positions, [&](const Point& x) { return box.contains(geometry::cell_of(cells.units.to_lattice(x))); }));
  };
  return result;
}

/// Points within `reach` of a place, but for those in a box.
double beyond(const Shares& shares, const Point& x, double reach, const CellBox& box) {
  const Point at = shares.units.to_lattice(x);
  const double radius = reach / shares.units.spacing;
  double found = 0;
  for (auto j = long(std::floor(at.y() - radius)); double(j) <= at.y() + radius; ++j) {
    const double half = std::sqrt(std::max(0.0, radius * radius - std::pow(double(j) - at.y(), 2)));
    const CellBox row{{long(std::ceil(at.x() - half)), j}, {long(std::floor(at.x() + half)) + 1, j + 1}};
    found += shares.count(row);
    if (const auto both = common(row, box); !is_empty(both)) found -= shares.count(both);
  }
  return found;
}

}  // namespace

std::vector<ForetoldPart> foretold_parts(const Problem& problem, int processes) {
  constexpr long seen = 4, rings = 3;  // cells about own points, and about these: part_of_cells(), cells_about()
  const auto paths = crack_paths(problem);
  const auto& d = problem.discretization;
  const bool graded = d.tip_spacing || d.hole_spacing;
  const auto whole = required_cells(problem, paths, true);
  require_parts(whole, processes);
  const auto shares = std::visit([&](const auto& cells) { return shares_of(cells, processes); }, whole);
  std::vector<ForetoldPart> result;
  for (std::size_t one = 0; one < shares.boxes.size(); ++one) {
    const auto box = shares.boxes[one].grown(seen + rings);
    ForetoldPart part{shares.points[one], shares.count(box), 0, graded};
    std::vector<CellBox> looked_at{box};
    for (const auto& tip : geometry::tips(paths)) {
      if (!shares.boxes[one].contains(geometry::cell_of(shares.units.to_lattice(tip.position)))) continue;
      const double reach = reach_about_tip(problem, tip) + (graded ? 0 : rings * d.spacing);
      part.seen += beyond(shares, tip.position, reach, box);
      const Point corner = Point::Constant(reach);
      looked_at.push_back(geometry::box_between(shares.units, tip.position - corner, tip.position + corner));
    }
    for (std::size_t other = 0; other < shares.boxes.size(); ++other)
      part.neighbours += other != one && std::ranges::any_of(looked_at, [&](const CellBox& cells) {
                           return !is_empty(common(cells, shares.boxes[other]));
                         });
    result.push_back(part);
  }
  return result;
}

}  // namespace plate
