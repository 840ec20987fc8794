#include "plate/galerkin/part_of_cells.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>

#include "geometry/cells/distributed_lattice.hpp"
#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/foundations.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/nodal_forces.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::CellBox;
using geometry::GlobalLattice;
using geometry::Point;
using geometry::Tessellation;

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

geometry::DistributedLattice checked_shares(const GlobalLattice& whole, int processes) {
  geometry::DistributedLattice shares(whole, processes);
  std::vector<std::size_t> counts;
  for (int one = 0; one < processes; ++one) counts.push_back(shares.part(one).points);
  require_enough(counts, whole.units().spacing, whole.size());
  return shares;
}

void extend(CellBox& box, const CellBox& by) {
  for (const std::size_t axis : {0, 1})
    box.low[axis] = std::min(box.low[axis], by.low[axis]), box.high[axis] = std::max(box.high[axis], by.high[axis]);
}

CellsWithOverlap all_cells(const Communicator& all, Tessellation whole) {
  CellsWithOverlap result;
  result.owners = checked_owners(whole, all.size());
  Point low = Point::Constant(INFINITY), high = -low;
  for (std::size_t k = 0; k < result.owners.size(); ++k)
    if (result.owners[k] == all.rank())
      low = low.cwiseMin(whole.positions[k]), high = high.cwiseMax(whole.positions[k]);
  result.own = geometry::box_between(whole.units, low, high);
  result.cells = std::move(whole);
  return result;
}

/// The cells of owned points and those that they see, `inner`, are among those with a place of which all is known; what
/// presses on points of these may be as far beyond as beams have between two places, with two cells to the nearest
/// point.
CellsWithOverlap cells_about(const Communicator& all, const Problem& problem, const GlobalLattice& whole,
                             const std::vector<geometry::Tip>& tips, const std::optional<CellBox>& besides) {
  constexpr long seen = 8;  // part_of_cells() sees half of that, and the elastic supports of the last of it
  const auto shares = checked_shares(whole, all.size());
  const auto& units = whole.units();
  const auto& part = shares.part(all.rank());
  CellsWithOverlap result;
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

std::size_t points_of(const GlobalCells& whole) {
  if (const auto* lattice = std::get_if<GlobalLattice>(&whole)) return lattice->size();
  return std::get<Tessellation>(whole).positions.size();
}

void require_parts(const GlobalCells& whole, int processes) {
  if (const auto* lattice = std::get_if<GlobalLattice>(&whole))
    checked_shares(*lattice, processes);
  else
    checked_owners(std::get<Tessellation>(whole), processes);
}

CellsWithOverlap cells_with_overlap(const Communicator& all, const Problem& problem, GlobalCells& whole,
                                    const std::vector<geometry::Tip>& tips, const std::optional<CellBox>& besides) {
  if (auto* cells = std::get_if<Tessellation>(&whole)) return all_cells(all, std::move(*cells));
  return cells_about(all, problem, std::get<GlobalLattice>(whole), tips, besides);
}

Tessellation about_first_inside(const GlobalCells& whole) {
  if (const auto* all = std::get_if<Tessellation>(&whole)) return all->graded ? Tessellation() : *all;
  const auto* lattice = std::get_if<GlobalLattice>(&whole);
  const auto first = lattice ? lattice->first_inside() : std::nullopt;
  if (!first) return {};
  const auto [i, j] = *first;
  constexpr long about = 5;
  return lattice->cells_at(CellBox{{i, j}, {i + 1, j + 1}}.grown(about)).cells;
}

namespace {

constexpr auto none = std::uint32_t(-1);

/// Number in the part of every point of the global plate; `none` where the part lacks the point.
std::vector<std::uint32_t> places(const geometry::CellsPart& part, std::size_t whole) {
  std::vector<std::uint32_t> result(whole, none);
  for (std::uint32_t i = 0; i < part.number.size(); ++i) result[part.number[i]] = i;
  return result;
}

/// The point nearest to a place, the first of several.
std::size_t nearest(const std::vector<Point>& positions, const Point& x) {
  std::size_t result = 0;
  for (std::size_t k = 1; k < positions.size(); ++k)
    if ((positions[k] - x).squaredNorm() < (positions[result] - x).squaredNorm()) result = k;
  return result;
}

/// Foundations and beams tie points that no cell does.
void include_elastic_supports(const ElasticSupports& elastic_supports, const std::vector<char>& own,
                              std::vector<char>& wanted) {
  for (const auto& one : elastic_supports.parts())
    one->for_each([&](const Dof& row, const Dof& column, double) {
      if (own[row.point]) wanted[column.point] = 1;
    });
}

/// The points of others, with their numbers there, for which these are asked.
std::vector<Copy> numbered(const Communicator& all, const std::vector<int>& owners, const PartOfCells& part) {
  const auto size = std::size_t(all.size());
  std::vector<std::vector<std::uint32_t>> here(size), asked(size);
  for (std::uint32_t i = 0; i < part.number.size(); ++i)
    if (const int owner = owners[part.part.number[i]]; owner != all.rank())
      here[std::size_t(owner)].push_back(i), asked[std::size_t(owner)].push_back(part.number[i]);
  return indices_at_owners(all, here, asked, [&](std::uint32_t number) {
    return std::uint32_t(std::ranges::lower_bound(part.number, number) - part.number.begin());
  });
}

constexpr double widest_ring = 28;  // spacings at the tips: the largest is 24 wide, and its points see others
constexpr double beside = 10;       // spacings of the plate: two horizons, over which openings are fitted, and more

}  // namespace

double widest_window(const Problem& problem) {
  const auto& d = problem.discretization;
  return widest_ring * d.spacing_at_tips() + (beside - 3) * d.spacing;
}

/// Openings are fitted over half a thickness at least; rings of graded points are as wide as there is room.
double reach_about_tip(const Problem& problem, const geometry::Tip& tip) {
  const auto& d = problem.discretization;
  double result = widest_ring * d.spacing_at_tips() + beside * d.spacing;
  const double thickness = problem.section.at(tip.position).thickness;
  result = std::max(result, thickness / 2 + beside * d.spacing);
  if (d.tip_spacing || d.hole_spacing)
    result = std::max(result, geometry::distance_to_boundary(problem.outline, tip.position) + beside * d.spacing);
  return result;
}

PartOfCells part_of_cells(const Communicator& all, const Problem& problem, const CellsWithOverlap& seen,
                          const ElasticSupports& elastic_supports, const std::vector<geometry::Tip>& tips,
                          const std::vector<char>& asked) {
  constexpr long near = 2;  // cells about the points: a place of the plate is as near to one of them
  const auto& positions = seen.cells.positions;
  std::vector<char> own(positions.size());
  for (std::size_t k = 0; k < own.size(); ++k) own[k] = seen.owners[k] == all.rank();
  PartOfCells result;
  const auto box = seen.own.grown(2 * near);
  result.about = seen.own.grown(near);
  auto wanted = own;
  include_elastic_supports(elastic_supports, own, wanted);
  for (std::size_t k = 0; k < asked.size(); ++k)
    if (asked[k]) wanted[k] = 1;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (box.contains(geometry::cell_of(seen.cells.units.to_lattice(positions[k])))) wanted[k] = 1;
  for (const auto& tip : tips) {
    if (!seen.cells.sees(tip.position) || !own[nearest(positions, tip.position)]) continue;
    const double reach = reach_about_tip(problem, tip);
    for (std::size_t k = 0; k < own.size(); ++k)
      if ((positions[k] - tip.position).norm() <= reach) wanted[k] = 1;
  }
  result.part = geometry::cells_about(seen.cells, std::move(wanted));
  for (const auto k : result.part.number) {
    result.number.push_back(seen.global_number(k)), result.own.push_back(own[k]);
    result.column_block.push_back(own[k] ? std::uint32_t(1 + geometry::column_block_of(seen.cells, k)) : 0);
  }
  result.copies = numbered(all, seen.owners, result);
  result.exchange = all.halo_exchange(result.part.number.size(), result.copies);
  return result;
}

namespace {

/// Offsets of what is held, by degrees of freedom of the global plate, found again from where it goes in every motion.
class DirichletLifts {
public:
  DirichletLifts(const Constraints& whole, std::size_t motions, std::size_t points) {
    for (std::size_t motion = 0; motion < motions; ++motion)
      if (auto lift = whole.lift(motion, points); lift.cols() > 0) lifts_.emplace(motion, std::move(lift));
  }
  std::vector<Constraints::Offset> of(const Dof& dof) const {
    std::vector<Constraints::Offset> result;
    for (const auto& [motion, lift] : lifts_)
      if (const double value = lift(dof.component, dof.point); value != 0) result.push_back({motion, value});
    return result;
  }

private:
  std::map<std::size_t, State> lifts_;
};

Constraints restricted(const Constraints& whole, const std::vector<std::uint32_t>& place, std::size_t motions) {
  Constraints result;
  const DirichletLifts lifts(whole, motions, place.size());
  const auto here = [&](const Dof& dof) { return plate::dof(place[dof.point], dof.component); };
  for (const auto dof : whole.fixed())
    if (place[dof.point] != none) result.fix(here(dof), lifts.of(dof));
  const auto& ties = whole.ties();
  for (std::size_t i = 0; i < ties.size();) {
    const auto follower = ties[i].follower;
    std::vector<Constraints::Leader> leaders;
    for (; i < ties.size() && ties[i].follower == follower; ++i)
      if (place[follower.point] != none) leaders.push_back({here(ties[i].leader), ties[i].factor});  // the point itself
    if (!leaders.empty()) result.tie(here(follower), std::move(leaders), lifts.of(follower));
  }
  result.resolve();
  return result;
}

}  // namespace

Boundary restricted(const Boundary& whole, const PartOfCells& part, std::size_t motions) {
  const auto& number = part.part.number;
  const auto place = places(part.part, whole.cloud.size());
  Boundary result;
  result.cloud = {whole.cloud.units, part.part.cells.positions, restricted(whole.cloud.areas, part.part), number.size(),
                  part.about};
  for (const auto k : number) result.lattice.push_back(whole.lattice[k]), result.active.push_back(whole.active[k]);
  result.sides = whole.sides, result.holders = whole.holders, result.warnings = whole.warnings;
  for (const auto& hold : whole.holds)
    if (place[hold.point] != none) result.holds.push_back({place[hold.point], hold.holder, hold.rotations});
  result.constraints = restricted(whole.constraints, place, motions);
  result.elastic_supports = restricted(whole.elastic_supports, part.part);
  result.map = {whole.map.communicator, part.own, part.number};
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < part.own.size(); ++i)
    if (!part.own[i]) others.push_back(i);
  result.constraints.share(*whole.map.communicator, std::move(others), part.exchange);
  return result;
}

namespace {

/// The places that press on nothing but points of the part: all that press on its own are among them.
template <typename Here>
std::shared_ptr<const Contact> restricted(const Contact& whole, const Here& here) {
  std::vector<Contact::Place> places;
  for (std::size_t p = 0; p < whole.places(); ++p) {
    auto place = whole.place(p);
    for (auto& term : place.form) term.first = here(term.first);
    if (std::ranges::none_of(place.form, [](const auto& term) { return term.first == none; }))
      places.push_back(std::move(place));
  }
  return std::make_shared<const Contact>(places);
}

}  // namespace

ElasticSupports restricted(const ElasticSupports& whole, const geometry::CellsPart& part) {
  std::vector<ElasticSupport> parts;
  for (const auto& one : whole.parts()) {
    const auto place = places(part, one->points);
    const auto points = part.number.size();
    const auto here = [&](std::uint32_t index) {
      const auto [point, component] = dof_at(index, one->points);
      return place[point] == none ? none : std::uint32_t(index_in_state({place[point], component}, points));
    };
    ElasticSupport own{
        .name = one->name, .position = one->position, .holds = one->holds, .joins = one->joins, .points = points};
    for (std::size_t r = 0; r < one->row.size(); ++r) {
      if (here(one->row[r]) == none) continue;
      own.row.push_back(here(one->row[r])), own.first.push_back(own.column.size());
      for (auto i = one->first[r]; i < one->first[r + 1]; ++i)
        if (const auto column = here(one->column[i]); column != none)
          own.column.push_back(column), own.value.push_back(one->value[i]);
    }
    own.first.push_back(own.column.size());
    if (one->contact) own.contact = restricted(*one->contact, here);
    parts.push_back(std::move(own));
  }
  return ElasticSupports(std::move(parts));
}

Forces restricted(const Forces& whole, const geometry::CellsPart& part) {
  Forces result(unknowns_per_point, whole.cols() == 0 ? 0 : Eigen::Index(part.number.size()));
  for (Eigen::Index i = 0; i < result.cols(); ++i) result.col(i) = whole.col(part.number[std::size_t(i)]);
  return result;
}

std::vector<double> restricted(const std::vector<double>& whole, const geometry::CellsPart& part) {
  std::vector<double> result;
  for (const auto k : part.number)
    if (!whole.empty()) result.push_back(whole[k]);
  return result;
}

MovingForces restricted(MovingForces whole, const PartOfCells& part) {
  const auto& number = part.part.number;
  for (auto& station : whole.stations) {
    std::erase_if(station.forces,
                  [&](const auto& one) { return !std::ranges::binary_search(number, one.first.point); });
    for (auto& dof : station.forces | std::views::keys)
      dof.point = std::uint32_t(std::ranges::lower_bound(number, dof.point) - number.begin());
  }
  whole.own = part.own;
  return whole;
}

}  // namespace plate
