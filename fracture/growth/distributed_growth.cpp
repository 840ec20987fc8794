#include "fracture/growth/distributed_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plate/bonds/part_of_lattice.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "plate/solve/gathered_archives.hpp"
#include "post/files/archive.hpp"
#include "post/files/summary.hpp"

namespace fracture {

namespace {

/// Order of peaks that does not depend on the order of the ranks: the larger comes first, then the earlier, the lower,
/// the one to the left.
bool before(const post::Peak& a, const post::Peak& b) {
  const auto key = [](const post::Peak& peak) {
    const auto x = peak.position.value_or(geometry::Point(0, 0));
    return std::array{-std::abs(peak.value), peak.time, x.y(), x.x()};
  };
  return key(a) < key(b);
}

}  // namespace

using geometry::Point;

PointNumbers::PointNumbers(const plate::Boundary& boundary) : boundary_(boundary) {
  if (!boundary.map.distributed()) return;
  const auto end = boundary.lattice.begin() + std::ptrdiff_t(boundary.cloud.plate_points);
  index_.emplace(std::vector<Point>(boundary.lattice.begin(), end));
  for (const auto& side : boundary.sides)
    if (!side.circle) columns_ = std::max(columns_, std::uint32_t(std::ceil(side.edge.to.x())));
}

std::uint32_t PointNumbers::of(std::uint32_t k) const {
  if (!index_) return k;
  const auto [column, row] = geometry::cell_of(boundary_.lattice[k]);
  return std::uint32_t(row) * columns_ + std::uint32_t(column);
}

Point PointNumbers::place(std::uint32_t number) const {
  if (!index_) return boundary_.lattice[number];
  return {double(number % columns_) + 0.5, double(number / columns_) + 0.5};
}

std::shared_ptr<const plate::Surroundings> overlap_of_growth(const plate::Formulation& start, bool tips) {
  // what decides about a bond that a point of the process has: the weights of its other end, whose bonds end three
  // horizons away at most
  const double horizon = start.discretization().horizon_ratio;
  auto seen = plate::surroundings(start.problem().outline, start.discretization(), start.boundary(),
                                  tips ? plate::reach_about_tips(horizon) : 3 * horizon + 2);
  return seen ? std::make_shared<const plate::Surroundings>(std::move(*seen)) : nullptr;
}

std::vector<post::Srif> of_all(const plate::Formulation& plate, std::vector<post::Srif> own) {
  if (!plate.distributed()) return own;
  auto result = plate::gathered_archives(plate, own);
  std::ranges::stable_sort(result, {}, &post::Srif::tip);
  return result;
}

std::vector<post::Peak> of_all(const plate::Formulation& plate, std::vector<post::Peak> own) {
  if (!plate.distributed()) return own;
  auto found = plate::gathered_archives(plate, own);
  std::vector<post::Peak> result;
  for (const auto& one : own) {
    std::erase_if(found, [&](const post::Peak& peak) { return peak.quantity == one.quantity && !peak.position; });
    auto of_quantity = found;
    std::erase_if(of_quantity, [&](const post::Peak& peak) { return peak.quantity != one.quantity; });
    if (!of_quantity.empty()) result.push_back(*std::ranges::min_element(of_quantity, before));
  }
  return result;
}

}  // namespace fracture
