#include "plate/formulation/supports/moved_supports.hpp"

#include "plate/formulation/boundary.hpp"

namespace plate {

using geometry::Point;

bool MovedSupports::moves(const SupportMotion& motion, const Side& side) const {
  const auto number = holder(boundary_->holders, side.name);
  return number < boundary_->holders.size() && boundary_->holders[number].support == motion.support;
}

Eigen::Vector3d MovedSupports::at(const SupportMotion& motion, const Point& lattice, const Side& side) const {
  const auto& units = boundary_->cloud.units;
  return motion.at(units.from_lattice(lattice), side.outward(lattice), -side.inside(lattice) * units.spacing);
}

MovedSupports::Offsets MovedSupports::of(std::uint32_t dof, const Side& side, const Leaders& leaders) const {
  Offsets result;
  for (const auto& motion : motions_) {
    if (!moves(motion, side)) continue;
    const auto value = [&](std::uint32_t one) { return at(motion, boundary_->lattice[one / 3], side)[one % 3]; };
    double offset = value(dof);
    for (const auto& [leader, factor] : leaders) offset -= factor * value(leader);
    result.push_back({motion.load, offset});
  }
  return result;
}

MovedSupports::Offsets MovedSupports::of_corner(std::uint32_t image, std::uint32_t point, std::uint32_t component,
                                                const Side& first, double first_sign, const Side& second,
                                                double second_sign) const {
  Offsets result;
  const Point &u = boundary_->lattice[point], between = first.mirrored(u), &last = boundary_->lattice[image];
  for (const auto& motion : motions_) {
    const auto value = [&](const Point& x, const Side& side) { return at(motion, x, side)[component]; };
    double offset = 0;
    if (moves(motion, second)) offset += value(last, second) - second_sign * value(between, second);
    if (moves(motion, first)) offset += second_sign * (value(between, first) - first_sign * value(u, first));
    if (offset != 0) result.push_back({motion.load, offset});
  }
  return result;
}

MovedSupports::Offsets MovedSupports::inside(std::size_t support, const Point& x, std::uint32_t component) const {
  Offsets result;
  for (const auto& motion : motions_)
    if (motion.support == support) result.push_back({motion.load, motion.at(x)[component]});
  return result;
}

}  // namespace plate
