#include "plate/formulation/parts/rigid_parts.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "plate/model/ranks/gathered.hpp"

namespace plate {
namespace {

using geometry::Point;

/// Coordinates in lattice units are multiples of 2^-20: no sound triangle has less area.
constexpr double straight = 1e-9;

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

RigidParts::RigidParts(const Boundary& boundary, const geometry::Families& families)
    : boundary_(boundary), families_(families), sets_(families.points()), line_(families.points(), Point(0, 0)) {
  for (std::uint32_t k = 0; k < families.points(); ++k) {
    const auto& constraints = boundary.constraints;
    follows_.push_back(!boundary.is_plate(k) && constraints.held(3 * k) && constraints.held(3 * k + 1) &&
                       constraints.held(3 * k + 2));
    line_[k] = line_of(k);
  }
  // what has an image is tied to all that the image is bonded to
  for (const auto& tie : boundary.constraints.ties())
    if (follows_[tie.follower / 3]) line_[tie.leader / 3] = Point(0, 0);
  for_each_bond([&](std::uint32_t k, std::uint32_t j) {
    if (follows_[k] || follows_[j] || sets_.root(k) == sets_.root(j)) return;
    if (on_line(k) && on_line(j)) sets_.join(k, j);  // one chain; its points' turns are counted one by one
    if (!on_line(k) && !on_line(j)) join_triangle(k, j);
  });
  number();
}

std::size_t RigidParts::count_of(const Ranks& all) {
  const auto numbers = set_numbers(sets_, boundary_);
  std::set<std::int64_t> own;
  for (std::uint32_t k = 0; k < boundary_.cloud.plate_points; ++k)
    if (boundary_.owns(k) && has(k)) own.insert(numbers[k]);
  const auto found = gathered(all, std::vector<std::int64_t>(own.begin(), own.end()));
  return std::set<std::int64_t>(found.begin(), found.end()).size();
}

void RigidParts::number() {
  part_.assign(families_.points(), none);
  for (std::uint32_t k = 0; k < families_.points(); ++k) {
    if (follows_[k] || (!boundary_.is_plate(k) && families_[k].empty())) continue;
    const auto root = sets_.root(k);
    if (root == k) {
      part_[k] = std::uint32_t(first_.size());
      first_.push_back(k), points_.push_back(0), extent_.push_back(1);
    }
    const auto own = part_[k] = part_[root];
    points_[own] += boundary_.is_plate(k);
    extent_[own] = std::max(extent_[own], (boundary_.lattice[k] - boundary_.lattice[root]).norm());
  }
}

Point RigidParts::line_of(std::uint32_t k) const {
  const auto family = families_[k];
  if (family.empty()) return {0, 0};
  const Point one = to(k, family[0].neighbour);
  for (const auto& bond : family)
    if (std::abs(cross(one, to(k, bond.neighbour))) > straight) return {0, 0};
  return one.normalized();
}

void RigidParts::join_triangle(std::uint32_t k, std::uint32_t j) {
  const auto own = families_[k], others = families_[j];
  for (std::size_t a = 0, b = 0; a < own.size() && b < others.size();) {
    const auto i = own[a].neighbour, other = others[b].neighbour;
    if (i == other && stores(k, i) && stores(j, i) && std::abs(cross(to(k, j), to(k, i))) > straight) {
      sets_.join(k, j);
      sets_.join(k, i);
      return;
    }
    a += i <= other;
    b += other <= i;
  }
}

}  // namespace plate
