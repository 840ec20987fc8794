#include "plate/formulation/hubs.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/cells/tessellation.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Circle;
using geometry::Point;

bool any_hub(const std::vector<Support>& supports) {
  return std::ranges::find(supports, SupportKind::hub, &Support::kind) != supports.end();
}

std::vector<std::uint32_t> points_within(const Circle& circle, const std::vector<Point>& positions, std::size_t count,
                                         double spacing) {
  constexpr double nothing = 1e-6;  // spacings
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < count; ++k)
    if ((positions[k] - circle.centre).norm() <= circle.radius + nothing * spacing) result.push_back(k);
  return result;
}

/// Points on one line have no turn about it.
void require_disc(const Hub& hub, const Holder& holder, const std::vector<Point>& positions, double spacing) {
  constexpr double least = 1e-3;  // spacings
  Point low(0, 0), high(0, 0), across(0, 0);
  for (const auto k : hub.points) {
    const Point from = positions[k] - positions[hub.points.front()];
    low = low.cwiseMin(from), high = high.cwiseMax(from);
    if (from.norm() > across.norm()) across = from;
  }
  const bool wide = std::ranges::any_of(hub.points, [&](auto k) {
    const Point from = positions[k] - positions[hub.points.front()];
    return std::abs(across.x() * from.y() - across.y() * from.x()) > least * spacing * across.norm();
  });
  if (wide && high.x() - low.x() > least * spacing) return;
  throw Refused(
      {{holder.place == Holder::Place::edge ? Subject::support_edges : Subject::support_patch, holder.support,
        fmt::format("the hub about ({:.4g}, {:.4g}) has {} points at spacing {:g}, too few for a disc: refine",
                    hub.centre.x(), hub.centre.y(), hub.points.size(), spacing)}});
}

/// Ties what turns and moves as a rigid body in the plane to u and v of one point and v of another: theta_y = u,
/// theta_x = -v. Both lie at the radius of gyration, left and right of the centre: their masses then turn as the disc.
void tie_in_plane(Constraints& constraints, const Hub& hub, const std::vector<Point>& positions) {
  const auto x = [&](std::uint32_t k) { return positions[k].x(); };
  double square = 0;
  for (const auto k : hub.points) square += (positions[k] - hub.centre).squaredNorm() / double(hub.points.size());
  const auto nearest_to = [&](const Point& place) {
    return *std::ranges::min_element(hub.points, {}, [&](auto k) { return (positions[k] - place).squaredNorm(); });
  };
  const Point gyration(std::sqrt(square), 0);
  std::uint32_t left = nearest_to(hub.centre - gyration), right = nearest_to(hub.centre + gyration);
  if (!(x(left) < x(right))) {  // of a few points
    const auto [first, last] = std::ranges::minmax_element(hub.points, {}, x);
    left = *first, right = *last;
  }
  const double width = x(right) - x(left);
  for (const auto k : hub.points) {
    const Point from = positions[k] - positions[left];
    const double along = from.x() / width, across = from.y() / width;
    if (k != left) constraints.tie(dof(k, 2), {{dof(left, 2), 1}, {dof(right, 1), across}, {dof(left, 1), -across}});
    if (k != left && k != right) constraints.tie(dof(k, 1), {{dof(left, 1), 1 - along}, {dof(right, 1), along}});
  }
}

void fix_in_plane(Boundary& boundary, const Hub& hub) {
  for (const auto k : hub.points) {
    for (std::uint32_t c = 1; c < unknowns_per_point; ++c) boundary.constraints.fix(dof(k, c));
    boundary.holds.push_back({k, hub.holder, true});
  }
}

/// Ties the points of a hub to the rotations of the first, and to its deflection where the centre is held by a spring.
void tie_in_bending(Boundary& boundary, const Hub& hub, const Support& support, const SupportOffsets& moved) {
  const auto& positions = boundary.cloud.positions;
  const auto number = boundary.holders[hub.holder].support;
  const auto first = hub.points.front();
  for (const auto k : hub.points) {
    for (std::uint32_t c = 1; c < unknowns_per_point; ++c)
      if (!support.k_phi)
        boundary.constraints.fix(dof(k, c), moved.inside(number, positions[k], c));
      else if (k != first)
        boundary.constraints.tie(dof(k, c), {{dof(first, c), 1}});
    const Point lever = positions[k] - (support.k_w ? positions[first] : hub.centre);
    SupportOffsets::Leaders leaders;
    if (support.k_w) leaders.push_back({dof(first, 0), 1});
    if (support.k_phi) leaders.push_back({dof(first, 1), lever.y()}), leaders.push_back({dof(first, 2), -lever.x()});
    if (leaders.empty())
      boundary.constraints.fix(dof(k, 0), moved.inside(number, positions[k], 0));
    else if (!support.k_w || k != first)
      boundary.constraints.tie(dof(k, 0), leaders, moved.inside(number, hub.centre, 0));
    for (const bool rotations : {false, true}) boundary.holds.push_back({k, hub.holder, rotations});
  }
}

void require_alone(const Boundary& boundary, const Hub& hub) {
  const std::set<std::uint32_t> points(hub.points.begin(), hub.points.end());
  for (const auto& hold : boundary.holds)
    if (hold.holder != hub.holder && points.contains(hold.point))
      throw Refused({{Subject::support, boundary.holders[hub.holder].support,
                      fmt::format("the hub about ({:.4g}, {:.4g}) has a point that \"{}\" holds too: move one of them",
                                  hub.centre.x(), hub.centre.y(), boundary.holders[hold.holder].name)}});
}

}  // namespace

std::vector<Hub> hubs_of(const std::vector<Support>& supports, const geometry::Cloud& cloud, double horizon,
                         const std::vector<geometry::CrackPath>& paths) {
  constexpr double about_rim = 0.215;  // horizons; measured (tests/verification, "Supports, soil and loads that move")
  std::vector<Hub> result;
  if (!any_hub(supports)) return result;
  const auto holders = holders_of(supports);
  for (std::uint32_t i = 0; i < holders.size(); ++i) {
    const auto& patch = supports[holders[i].support].patch;
    const auto* circle = patch ? std::get_if<Circle>(&*patch) : nullptr;
    if (holders[i].kind != SupportKind::hub) continue;
    if (!circle)
      throw Refused(
          {{Subject::support_edges, holders[i].support,
            "bonds have no points on the rim of a hole, which a hub would move: remove what needs bonds, or give "
            "on = { circle = [x, y, radius] } without the hole"}});
    const double spacing = cloud.units.spacing;
    const Circle held{circle->centre, circle->radius + about_rim * horizon, circle->name};
    auto points = points_within(held, cloud.positions, cloud.plate_points, spacing);
    std::erase_if(points, [&](std::uint32_t k) {
      const Point arm = cloud.positions[k] - circle->centre;
      const Point rim = circle->centre + arm * std::min(1.0, circle->radius / arm.norm());
      return std::ranges::any_of(paths,
                                 [&](const auto& path) { return geometry::separates(path, rim, cloud.positions[k]); });
    });
    result.push_back({i, circle->centre, std::move(points)});
    require_disc(result.back(), holders[i], cloud.positions, spacing);
  }
  return result;
}

std::vector<Hub> hubs_of(const std::vector<Support>& supports, const geometry::Outline& outline,
                         const geometry::Tessellation& cells) {
  std::vector<Hub> result;
  if (!any_hub(supports)) return result;
  const auto holders = holders_of(supports);
  const auto& positions = cells.positions;
  const double spacing = cells.units.spacing;
  const auto add = [&](std::uint32_t i, const Point& centre, std::vector<std::uint32_t> points) {
    result.push_back({i, centre, std::move(points)});
    require_disc(result.back(), holders[i], positions, spacing);
  };
  for (std::uint32_t i = 0; i < holders.size(); ++i) {
    if (holders[i].kind != SupportKind::hub) continue;
    if (const auto& patch = supports[holders[i].support].patch) {
      const auto& circle = std::get<Circle>(*patch);
      add(i, circle.centre, points_within(circle, positions, positions.size(), spacing));
      continue;
    }
    for (const auto& hole : outline.holes) {
      const auto* circle = std::get_if<Circle>(&hole);
      if (!circle || circle->name != holders[i].name) continue;
      std::set<std::uint32_t> rim;
      for (const auto& border : cells.borders)
        if (border.edge != geometry::Curves::crack && cells.names[std::size_t(border.edge)] == circle->name)
          rim.insert({border.from, border.to});
      add(i, cells.units.from_lattice(circle->centre), {rim.begin(), rim.end()});
    }
  }
  return result;
}

bool hubs_move(const std::vector<Support>& supports, PlateLaw law) {
  return std::ranges::any_of(supports, [&](const Support& support) {
    const bool moves = law == PlateLaw::membrane ? support.held_in_plane() != InPlane::fixed
                                                 : support.k_w.has_value() || support.k_phi.has_value();
    return support.kind == SupportKind::hub && moves;
  });
}

void hold_hubs(Boundary& boundary, const std::vector<Hub>& hubs, const std::vector<Support>& supports, PlateLaw law,
               const SupportOffsets& moved) {
  for (const auto& hub : hubs) {
    boundary.holders[hub.holder].position = hub.centre;
    const auto& support = supports[boundary.holders[hub.holder].support];
    if (law == PlateLaw::membrane && support.held_in_plane() == InPlane::fixed)
      fix_in_plane(boundary, hub);
    else if (law == PlateLaw::membrane)
      tie_in_plane(boundary.constraints, hub, boundary.cloud.positions);
    else
      tie_in_bending(boundary, hub, support, moved);
  }
  for (const auto& hub : hubs) require_alone(boundary, hub);
}

bool add_hub(const Hub& hub, const Support& support, const std::vector<Point>& positions, ElasticSupportSum& sum) {
  const auto first = hub.points.front();
  const Point lever = hub.centre - positions[first];
  if (support.k_w) sum.add(*support.k_w, {{dof(first, 0), 1}, {dof(first, 1), lever.y()}, {dof(first, 2), -lever.x()}});
  const double turn = support.k_phi.value_or(0);
  for (std::uint32_t c = 1; turn > 0 && c < unknowns_per_point; ++c) sum.add(turn, {{dof(first, c), 1}});
  return support.k_w || turn > 0;
}

}  // namespace plate
