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

/// Motion in the plane by u and v of one point and v of another: theta_y = u, theta_x = -v. Both lie at the radius of
/// gyration, left and right of the centre: their masses then turn as the disc.
BodyMotion motion_in_plane(const Hub& hub, const std::vector<Point>& positions) {
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
  return [left, right, origin = positions[left], width = x(right) - x(left)](const Point& at, std::uint32_t component) {
    const Point from = at - origin;
    const double along = from.x() / width, across = from.y() / width;
    using Leaders = SupportOffsets::Leaders;
    if (component == 0) return BodyValue{};
    return BodyValue{component == 2 ? Leaders{{dof(left, 2), 1}, {dof(right, 1), across}, {dof(left, 1), -across}}
                                    : Leaders{{dof(left, 1), 1 - along}, {dof(right, 1), along}},
                     {}};
  };
}

/// Motion by the rotations of the first point, and by its deflection where the centre is held by a spring.
BodyMotion motion_in_bending(const Hub& hub, std::size_t number, const Support& support,
                             const std::vector<Point>& positions, const SupportOffsets& moved) {
  return [&moved, number, first = hub.points.front(), centre = hub.centre, turns = support.k_phi.has_value(),
          sinks = support.k_w.has_value(),
          origin = positions[hub.points.front()]](const Point& at, std::uint32_t component) -> BodyValue {
    if (component > 0 && turns) return {{{dof(first, component), 1}}, {}};
    if (component > 0) return {{}, moved.inside(number, at, component)};
    const Point lever = at - (sinks ? origin : centre);
    SupportOffsets::Leaders leaders;
    if (sinks) leaders.push_back({dof(first, 0), 1});
    if (turns) leaders.push_back({dof(first, 1), lever.y()}), leaders.push_back({dof(first, 2), -lever.x()});
    return {leaders, moved.inside(number, leaders.empty() ? at : centre, 0)};
  };
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

std::vector<Hub> hubs_of(const std::vector<Support>& supports, const geometry::Cloud& cloud) {
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
    result.push_back({i, circle->centre, points_on(*circle, cloud)});
    require_disc(result.back(), holders[i], cloud.positions, cloud.units.spacing);
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
      add(i, circle.centre, points_on(circle, {cells.units, positions, {}, positions.size(), {}}));
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

BodyMotion motion_of(const Hub& hub, const Boundary& boundary, const std::vector<Support>& supports, PlateLaw law,
                     const SupportOffsets& moved) {
  const auto number = boundary.holders[hub.holder].support;
  const auto& support = supports[number];
  const auto& positions = boundary.cloud.positions;
  if (law != PlateLaw::membrane) return motion_in_bending(hub, number, support, positions, moved);
  if (support.held_in_plane() != InPlane::fixed) return motion_in_plane(hub, positions);
  return [](const Point&, std::uint32_t) { return BodyValue{}; };
}

void tie_to_body(Constraints& constraints, const Dof& dof, BodyValue value) {
  auto& [leaders, offsets] = value;
  if (leaders.empty())
    constraints.fix(dof, std::move(offsets));
  else if (std::ranges::find(leaders, dof, &Constraints::Leader::dof) == leaders.end())
    constraints.tie(dof, std::move(leaders), std::move(offsets));
}

void hold_hubs(Boundary& boundary, const std::vector<Hub>& hubs, const std::vector<Support>& supports, PlateLaw law,
               const SupportOffsets& moved) {
  for (const auto& hub : hubs) {
    boundary.holders[hub.holder].position = hub.centre;
    const bool bends = law != PlateLaw::membrane;
    const bool fixed = bends || supports[boundary.holders[hub.holder].support].held_in_plane() == InPlane::fixed;
    const auto motion = motion_of(hub, boundary, supports, law, moved);
    for (const auto k : hub.points) {
      for (std::uint32_t c = bends ? 0 : 1; c < unknowns_per_point; ++c)
        tie_to_body(boundary.constraints, dof(k, c), motion(boundary.cloud.positions[k], c));
      if (bends) boundary.holds.push_back({k, hub.holder, false});
      if (fixed) boundary.holds.push_back({k, hub.holder, true});
    }
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
