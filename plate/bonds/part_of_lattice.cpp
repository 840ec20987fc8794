#include "plate/bonds/part_of_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/lattice/cloud.hpp"
#include "plate/model/communicator.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/halo_exchange.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Cell;

/// Points of the plate that are not one's own, and what they follow.
class Overlap {
public:
  Overlap(const PartOfLattice& part, const Boundary& boundary) : part_(part), boundary_(boundary) {
    for (const auto& tie : boundary.constraints.ties()) leaders_.emplace_back(tie.follower.point, tie.leader.point);
    std::sort(leaders_.begin(), leaders_.end());
    leaders_.erase(std::unique(leaders_.begin(), leaders_.end()), leaders_.end());
  }

  bool own(std::uint32_t k) const { return boundary_.is_plate(k) && part_.own.contains(cell(k)); }
  Cell cell(std::uint32_t k) const { return geometry::cell_of(boundary_.lattice[k]); }

  /// Flags of owned points, and of what follows one of them.
  std::vector<char> wanted() const {
    std::vector<char> result(boundary_.cloud.size(), 0);
    for (std::uint32_t k = 0; k < boundary_.cloud.plate_points; ++k) result[k] = own(k);
    for (const auto& [follower, leader] : leaders_)
      if (own(leader)) result[follower] = 1;
    return result;
  }

  /// Ghosts: neighbours of the wanted points, points about own tips [spacings], and the points that these follow,
  /// except owned points.
  std::vector<std::uint32_t> copies(const std::vector<char>& wanted, const geometry::Families& families,
                                    const std::vector<geometry::Point>& tips) const {
    std::vector<char> seen = wanted;
    for (const auto& tip : tips)
      for (std::uint32_t k = 0; k < boundary_.cloud.plate_points; ++k)
        if ((boundary_.lattice[k] - tip).norm() <= part_.about_tips) seen[k] = 1;
    for (std::uint32_t k = 0; k < wanted.size(); ++k)
      if (wanted[k])
        for (const auto& bond : families[k]) seen[bond.neighbour] = 1;
    include_elastic_supports(seen, families);
    for (const auto& [follower, leader] : leaders_)
      if (seen[follower]) seen[leader] = 1;
    std::vector<std::uint32_t> result;
    for (std::uint32_t k = 0; k < boundary_.cloud.plate_points; ++k)
      if (seen[k] && !own(k)) result.push_back(k);
    return result;
  }

  /// Flags of the points within `cells` of the rank's own box, and of the points that these follow.
  std::vector<char> near(long cells) const {
    const auto box = part_.own.grown(cells);
    std::vector<char> result(boundary_.cloud.size(), 0);
    for (std::uint32_t k = 0; k < result.size(); ++k) result[k] = box.contains(cell(k));
    for (const auto& [follower, leader] : leaders_)
      if (box.contains(cell(follower))) result[leader] = 1;
    return result;
  }

private:
  /// Soil ties points that no bond does, across cracks: these too, and what they see.
  void include_elastic_supports(std::vector<char>& seen, const geometry::Families& families) const {
    std::vector<std::uint32_t> tied;
    for (const auto& one : boundary_.elastic_supports.parts())
      one->for_each([&](const Dof& row, const Dof& column, double) {
        const auto k = row.point, j = column.point;
        if (k != j && seen[k] && families[k].find(j) == families[k].size()) tied.push_back(j);
      });
    for (const auto k : tied) {
      seen[k] = 1;
      for (const auto& bond : families[k]) seen[bond.neighbour] = 1;
    }
  }

  const PartOfLattice& part_;
  const Boundary& boundary_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> leaders_;  // follower, leader: points
};

/// Asks the owners of ghosts for their numbers.
std::vector<Copy> numbered(const Communicator& all, const PartOfLattice& part, const Overlap& seen,
                           const Boundary& boundary, const std::vector<std::uint32_t>& copies) {
  const auto size = std::size_t(all.size());
  std::vector<std::vector<std::uint32_t>> of_owner(size);
  std::vector<std::vector<Cell>> asked(size);
  for (const auto k : copies) {
    const Cell cell = seen.cell(k);
    const auto owner = std::size_t(part.partition.owner(cell));
    of_owner[owner].push_back(k), asked[owner].push_back(cell);
  }
  const auto end = boundary.lattice.begin() + std::ptrdiff_t(boundary.cloud.plate_points);
  const geometry::CellIndex index({boundary.lattice.begin(), end});  // images within bodies share their cells
  return indices_at_owners(all, of_owner, asked, [&](const Cell& cell) {
    return index.at(geometry::Point(double(cell[0]) + 0.5, double(cell[1]) + 0.5)).value();
  });
}

/// Fictitious points: those that follow a w are of whom that is, the others of whose block is nearest. Whatever is held
/// alone reacts there, and each reaction must count once.
void own_fictitious(const PartOfLattice& part, const Overlap& seen, Boundary& boundary) {
  const int self = boundary.map.rank();
  for (std::uint32_t k = boundary.cloud.plate_points; k < boundary.cloud.size(); ++k)
    boundary.map.owned[k] = part.partition.nearest_owner(seen.cell(k)) == self;
  for (const auto& tie : boundary.constraints.ties())
    if (const auto k = tie.follower.point; !boundary.is_plate(k) && is_deflection(tie.follower))
      boundary.map.owned[k] = boundary.map.owned[tie.leader.point];
}

}  // namespace

geometry::Partition partition_of_lattice(const geometry::Outline& outline, const Discretization& discretization,
                                         int processes) {
  const geometry::LatticeUnits units{geometry::bounding_box(outline).first, discretization.spacing};
  geometry::Partition partition(geometry::to_lattice(outline, units), processes);
  if (partition.blocks() < std::size_t(processes))
    throw Refused(
        {{Subject::spacing, 0,
          fmt::format("{:g} given makes {} blocks of {} by {} points, too few for {} processes", discretization.spacing,
                      partition.blocks(), geometry::Partition::block[0], geometry::Partition::block[1], processes)}});
  return partition;
}

/// Margin about the wanted points: two horizons for the parameters of what a neighbour sees, the rest for images at
/// oblique edges and for checks, which look 12 spacings far.
long margin_of_part(const Discretization& discretization) {
  const double about_tips = reach_about_tips(discretization.horizon_ratio);
  return 2 * long(std::ceil(discretization.horizon_ratio)) + 24 + long(std::ceil(about_tips));
}

std::optional<PartOfLattice> part_of_lattice(const Communicator& all, const geometry::Outline& outline,
                                             const Discretization& discretization) {
  if (!all.distributed()) return std::nullopt;
  auto partition = partition_of_lattice(outline, discretization, all.size());
  const auto own = partition.box(all.rank());
  return PartOfLattice{std::move(partition), own, own.grown(margin_of_part(discretization)),
                       reach_about_tips(discretization.horizon_ratio)};
}

std::optional<Surroundings> surroundings(const geometry::Outline& outline, const Discretization& discretization,
                                         const Boundary& boundary, double reach) {
  const Communicator& all = *boundary.map.communicator;
  const auto part = part_of_lattice(all, outline, discretization);
  if (!part) return std::nullopt;
  const Overlap seen(*part, boundary);
  Surroundings result{seen.near(long(std::ceil(reach))), nullptr};
  std::vector<std::uint32_t> copies;
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (result.known[k] && !seen.own(k)) copies.push_back(k);
  result.exchange = all.halo_exchange(boundary.cloud.size(), numbered(all, *part, seen, boundary, copies));
  return result;
}

OperatedPart operated(const PartOfLattice& part, Boundary& boundary, const geometry::Families& families,
                      const std::vector<geometry::Tip>& tips) {
  const Communicator& all = *boundary.map.communicator;
  const Overlap seen(part, boundary);
  OperatedPart result;
  result.communicator = &all;
  for (std::uint32_t k = 0; k < boundary.cloud.size(); ++k) result.block.push_back(part.partition.number(seen.cell(k)));
  std::vector<geometry::Point> own_tips;
  for (const auto& tip : tips)
    if (boundary.cloud.seeded(tip.position) &&
        seen.own(std::uint32_t(geometry::nearest_plate_point(boundary.cloud, tip.position))))
      own_tips.push_back(boundary.cloud.units.to_lattice(tip.position));
  result.wanted = seen.wanted();
  boundary.map.owned.assign(boundary.cloud.size(), 0);
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k) boundary.map.owned[k] = seen.own(k);
  own_fictitious(part, seen, boundary);
  for (std::uint32_t k = boundary.cloud.plate_points; k < boundary.cloud.size(); ++k)
    if (boundary.map.owned[k]) result.wanted[k] = 1;
  const auto copies = seen.copies(result.wanted, families, own_tips);
  result.exchange = all.halo_exchange(boundary.cloud.size(), numbered(all, part, seen, boundary, copies));
  std::vector<std::uint32_t> others;  // ghosts, and what nobody here needs
  for (std::uint32_t k = 0; k < boundary.cloud.plate_points; ++k)
    if (!seen.own(k)) others.push_back(k);
  boundary.constraints.share(all, std::move(others), result.exchange);
  result.pending = boundary.constraints.pending(boundary.cloud.size());
  return result;
}

}  // namespace plate
