#include "fracture/breakage/breakage_checkpoint.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "fracture/breakage/damaged_plate.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/solve/gathered_archives.hpp"

namespace fracture {

PointKeys::PointKeys(const plate::Boundary& boundary)
    : boundary_(boundary),
      plate_({boundary.lattice.begin(), boundary.lattice.begin() + std::ptrdiff_t(boundary.cloud.plate_points)}) {
  for (auto k = std::uint32_t(boundary.cloud.plate_points); k < boundary.cloud.size(); ++k)
    fictitious_[geometry::cell_of(boundary.lattice[k])].push_back(k);
}

PointKey PointKeys::of(std::uint32_t k) const {
  const auto cell = geometry::cell_of(boundary_.lattice[k]);
  if (boundary_.is_plate(k)) return {cell[0], cell[1], 0};
  const auto& there = fictitious_.at(cell);
  return {cell[0], cell[1], std::ranges::find(there, k) - there.begin() + 1};
}

std::optional<std::uint32_t> PointKeys::point(const PointKey& key) const {
  const auto& [column, row, which] = key;
  if (which == 0) return plate_.at({double(column) + 0.5, double(row) + 0.5});
  const auto found = fictitious_.find({long(column), long(row)});
  if (found == fictitious_.end() || found->second.size() < std::size_t(which)) return std::nullopt;
  return found->second[std::size_t(which) - 1];
}

void DamagedPlate::save(plate::OutArchive& archive) const {
  BreakageCheckpoint result;
  const PointKeys keys(boundary_);
  for (std::size_t number = 0; number < changed_.size(); ++number) {
    const auto& [now, target, a_target, left, ongoing] = changed_[number];
    if (!boundary_.owns(now.point)) continue;
    DamagedFamily one{keys.of(now.point), first_losses_[number].event, first_losses_[number].place, now.a, left, {}};
    for (const auto& going : going_)
      if (ongoing && std::ranges::binary_search(going.points, now.point)) one.breakage = going.number;
    for (std::size_t i = 0; i < now.bonds.size(); ++i) {
      one.broken.push_back(broken_.broken(now.point, i));
      const auto& weights = now.bonds[i].weights;
      one.weights.insert(one.weights.end(), {weights.D, weights.B, weights.S});
    }
    result.families.push_back(std::move(one));
  }
  result.families = plate::gathered_archives(boundary_.map, std::move(result.families));
  for (const auto& one : going_) result.going.emplace_back(one.number, one.share);
  result.events = events_, result.breakages = breakages_, result.easing_left = easing_left_;
  archive(result);
  if (plane_) plane_->save(archive);
}

/// Families come in the order in which they lost their first bonds, as every process had them: of a piece of crack by
/// their points, of single bonds by these.
void DamagedPlate::load(plate::InArchive& archive) {
  BreakageCheckpoint memory;
  archive(memory);
  constexpr std::size_t each = 3;  // weights of a bond
  const PointKeys keys(boundary_);
  std::vector<std::pair<std::uint32_t, const DamagedFamily*>> found;
  for (const auto& one : memory.families)
    if (const auto k = keys.point(one.point); k && known(*k)) found.emplace_back(*k, &one);
  std::ranges::sort(found, {},
                    [](const auto& one) { return std::tuple(one.second->event, one.second->place, one.first); });
  for (const auto& [number, share] : memory.going) going_.push_back({number, {}, share});
  for (const auto& [k, one] : found) {
    if (one->broken.size() != base_.families()[k].size() || one->weights.size() != each * one->broken.size())
      throw std::runtime_error("the checkpoint has other bonds than the plate");
    events_ = one->event;
    for (std::size_t i = 0; i < one->broken.size(); ++i)
      if (one->broken[i]) lose(k, i, one->place);
    auto& changed = change(k);
    changed.now.a = one->a, changed.left = one->left, changed.ongoing = one->breakage.has_value();
    for (std::size_t i = 0; i < changed.now.bonds.size(); ++i)
      changed.now.bonds[i].weights = {one->weights[each * i], one->weights[each * i + 1], one->weights[each * i + 2]};
    retarget(k);
    differ(std::size_t(broken_.number(k)));
    if (one->left > 0) easing_.push_back(k);
    if (one->breakage) std::ranges::find(going_, *one->breakage, &OngoingBreakage::number)->points.push_back(k);
  }
  std::ranges::sort(easing_);
  for (auto& one : going_) std::ranges::sort(one.points);
  events_ = memory.events, breakages_ = memory.breakages, easing_left_ = memory.easing_left;
  if (plane_) plane_->load(archive);
}

}  // namespace fracture
