#include "fracture/severing/shared_points.hpp"

#include <algorithm>
#include <cmath>

#include "plate/bonds/part_of_lattice.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/ranks/ranks.hpp"

namespace fracture {

using geometry::Point;

PointNumbers::PointNumbers(const plate::Boundary& boundary) : boundary_(boundary) {
  if (!plate::ranks()) return;
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

std::optional<std::uint32_t> PointNumbers::point(std::uint32_t number) const {
  return index_ ? index_->at(place(number)) : number;
}

Point PointNumbers::place(std::uint32_t number) const {
  if (!index_) return boundary_.lattice[number];
  return {double(number % columns_) + 0.5, double(number / columns_) + 0.5};
}

std::shared_ptr<const plate::Surroundings> seen_by_growth(const plate::Formulation& start, bool tips) {
  // what decides about a bond that a point of the process has: the weights of its other end, whose bonds end three
  // horizons away at most
  const double horizon = start.discretization().horizon_ratio;
  auto seen = plate::surroundings(start.problem().outline, start.discretization(), start.boundary(),
                                  tips ? plate::reach_about_tips(horizon) : 3 * horizon + 2);
  return seen ? std::make_shared<const plate::Surroundings>(std::move(*seen)) : nullptr;
}

}  // namespace fracture
