#include "plate/galerkin/supports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "plate/formulation/hubs.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Point;

using Offsets = std::map<std::size_t, double>;  // by motion of supports

/// d . psi = 0, or what motions of supports make of it.
struct Direction {
  Point d;
  Offsets offsets;
};

/// Constraints of supports on one point: w = 0, and d . psi = 0 for every direction d; with support motions, the
/// prescribed values.
struct HeldPoint {
  bool w = false;
  Offsets of_w;
  std::vector<Direction> directions;
  std::set<std::uint32_t> holders_of_w, holders_of_psi;
};

/// Adds a direction; one within 30 degrees of another is merged with it, on a circle, of which there are eight pieces
/// at least, within 60.
void add_direction(std::vector<Direction>& directions, const Direction& added, bool round) {
  const auto& d = added.d;
  for (auto& known : directions)
    if (std::abs(known.d.normalized().dot(d)) > (round ? 0.5 : std::sqrt(0.75))) {
      const double sign = known.d.dot(d) > 0 ? 1 : -1;
      known.d += sign * d;
      for (const auto& [motion, value] : added.offsets) known.offsets[motion] += sign * value;
      return;
    }
  directions.push_back(added);
}

/// A piece of an edge that holds its ends.
struct Holding {
  SupportKind kind;
  std::uint32_t holder;
  Point normal;
  bool round;
  std::vector<const SupportMotion*> motions;  // of its support
};

/// The first holder says where w is: settlements that move others at one place elsewhere are refused.
void hold(HeldPoint& held, const Holding& by, const Point& x) {
  using enum SupportKind;
  const Point& normal = by.normal;
  const Point along(-normal.y(), normal.x());
  if (by.kind != symmetry) {
    if (!held.w)
      for (const auto* motion : by.motions) held.of_w[motion->load] = motion->at(x)[0];
    held.w = true, held.holders_of_w.insert(by.holder);
  }
  if (by.kind != simply_supported) held.holders_of_psi.insert(by.holder);
  const auto direction = [&](const Point& d) {
    Direction result{d, {}};
    for (const auto* motion : by.motions) {
      const auto body = motion->at(x, normal, 0);
      result.offsets[motion->load] = d.dot(Point(-body[2], body[1]));
    }
    return result;
  };
  if (by.kind == clamped || by.kind == symmetry) add_direction(held.directions, direction(normal), by.round);
  if (by.kind == clamped || by.kind == simply_supported_hard)
    add_direction(held.directions, direction(along), by.round);
}

std::vector<Constraints::Offset> times(double factor, const Offsets& offsets) {
  std::vector<Constraints::Offset> result;
  for (const auto& [motion, value] : offsets) result.push_back({motion, factor * value});
  return result;
}

/// Imposes both rotations, from what two directions have: psi = (-theta_y, theta_x).
void impose_both(Constraints& constraints, std::uint32_t k, const Direction& one, const Direction& other) {
  Offsets theta_x, theta_y;
  const double size = one.d.x() * other.d.y() - one.d.y() * other.d.x();
  const auto add = [&](const Offsets& offsets, double of_x, double of_y) {
    for (const auto& [motion, value] : offsets)
      theta_y[motion] -= value * of_x / size, theta_x[motion] += value * of_y / size;
  };
  add(one.offsets, other.d.y(), -other.d.x());
  add(other.offsets, -one.d.y(), one.d.x());
  constraints.fix(dof(k, 1), times(1, theta_x)), constraints.fix(dof(k, 2), times(1, theta_y));
}

/// psi = (-theta_y, theta_x)
void impose(Constraints& constraints, std::uint32_t k, const HeldPoint& held) {
  if (held.w) constraints.fix(dof(k, 0), times(1, held.of_w));
  if (held.directions.size() > 1) {
    impose_both(constraints, k, held.directions[0], held.directions[1]);
  } else if (held.directions.size() == 1) {
    const double length = held.directions.front().d.norm();
    const Point d = held.directions.front().d / length;
    const auto& offsets = held.directions.front().offsets;
    const bool by_x = std::abs(d.y()) >= std::abs(d.x());
    const auto larger = dof(k, by_x ? 1 : 2), other = dof(k, by_x ? 2 : 1);
    const double ratio = by_x ? d.x() / d.y() : d.y() / d.x();
    const auto own = times(by_x ? 1 / (d.y() * length) : -1 / (d.x() * length), offsets);
    if (std::abs(ratio) < 1e-9)
      constraints.fix(larger, own);
    else
      constraints.tie(larger, {{other, ratio}}, own);
  }
}

/// Points at one place, as on both faces of a crack, are held together.
void hold_places(Boundary& boundary, const SupportOffsets& moved) {
  const auto& positions = boundary.cloud.positions;
  for (std::uint32_t pin = 0; pin < boundary.holders.size(); ++pin) {
    if (!boundary.holders[pin].position || !boundary.cloud.seeded(*boundary.holders[pin].position)) continue;
    const auto nearest = geometry::nearest_plate_point(boundary.cloud, *boundary.holders[pin].position);
    for (std::uint32_t k = 0; k < positions.size(); ++k)
      if (positions[k] == positions[nearest]) hold_point(boundary, k, pin, moved);
  }
}

/// Numbers of the points on the rim of the part that a support holds. Of circles and of polygons with short edges it
/// lies beside the boundary of the part.
std::set<std::uint32_t> points_of_rim(const geometry::Tessellation& cells, std::size_t support,
                                      const geometry::Hole& part) {
  const auto name = std::ranges::find(cells.names, PartedBody{support, part}.name()) - cells.names.begin();
  std::set<std::uint32_t> result;
  for (const auto& border : cells.borders)
    if (border.edge != geometry::Curves::crack && border.edge == name) result.insert({border.from, border.to});
  return result;
}

/// Holds the points on the rims of clamped parts that lie beside the parts.
void hold_rims(Boundary& boundary, const geometry::Tessellation& cells, const std::vector<Support>& supports,
               const SupportOffsets& moved) {
  for (std::uint32_t by = 0; by < boundary.holders.size(); ++by) {
    const auto& holder = boundary.holders[by];
    const auto& support = supports[holder.support];
    if (holder.place != Holder::Place::inside || holder.kind != SupportKind::clamped || !support.patch) continue;
    auto points = points_of_rim(cells, holder.support, *support.patch);
    for (const auto k : points_on(*support.patch, boundary.cloud)) points.erase(k);  // held as those within
    for (const auto k : points) hold_point(boundary, k, by, moved);
  }
}

/// Ties the points at each place of the rims of bodies that nothing holds as bodies here, as in the plane of a part
/// that is clamped across it alone: the plate goes on there.
void join_rims(Boundary& boundary, const geometry::Tessellation& cells, const std::vector<Support>& supports) {
  for (std::size_t i = 0; i < supports.size(); ++i) {
    if (!supports[i].patch || is_body(supports[i])) continue;
    std::map<std::pair<double, double>, std::uint32_t> first;
    for (const auto k : points_of_rim(cells, i, *supports[i].patch)) {
      const auto& x = cells.positions[k];
      const auto leader = first.try_emplace({x.x(), x.y()}, k).first->second;
      for (std::uint32_t c = 0; leader != k && c < unknowns_per_point; ++c)
        boundary.constraints.tie(dof(k, c), {{dof(leader, c), 1}});
    }
  }
}

}  // namespace

Boundary galerkin_boundary(const geometry::Tessellation& cells, const std::vector<double>& areas,
                           const geometry::Outline& outline, const std::vector<Support>& supports,
                           const std::vector<SupportMotion>& motions, PointMap map, PlateLaw law) {
  Boundary result;
  result.map = std::move(map);
  result.cloud = {cells.units, cells.positions, areas, cells.positions.size()};
  if (cells.window) result.cloud.part = cells.window->about;
  for (const auto& x : cells.positions) result.lattice.push_back(cells.units.to_lattice(x));
  result.sides = sides_of(outline, supports);
  result.active.assign(cells.positions.size(), 1);

  result.holders = holders_of(supports);
  std::set<std::string> round;
  for (const auto& side : result.sides)
    if (side.circle) round.insert(side.name);
  std::map<std::uint32_t, HeldPoint> held;
  for (const auto& border : cells.borders) {
    if (border.edge == geometry::Curves::crack) continue;
    const auto by = holder(result.holders, cells.names[std::size_t(border.edge)]);
    if (by == result.holders.size()) continue;
    const Point along = (cells.positions[border.to] - cells.positions[border.from]).normalized();
    const auto& who = result.holders[by];
    if (who.kind == SupportKind::hub) continue;
    Holding holding{who.kind, by, {along.y(), -along.x()}, round.contains(who.name), {}};
    for (const auto& motion : motions)
      if (motion.settlement.support == who.support) holding.motions.push_back(&motion);
    for (const auto k : {border.from, border.to}) {
      hold(held[k], holding, cells.positions[k]);
      if (who.push != Push::both_ways) held[k].of_w[SupportOffsets::gap(k)] = 1;
    }
  }
  for (const auto& [k, what] : held) {
    impose(result.constraints, k, what);
    for (const auto by : what.holders_of_w) result.holds.push_back({k, by, false});
    for (const auto by : what.holders_of_psi) result.holds.push_back({k, by, true});
  }
  const SupportOffsets moved(result, motions);
  hold_places(result, moved);
  hold_inside(result, supports, moved);
  hold_rims(result, cells, supports, moved);
  hold_hubs(result, hubs_of(supports, outline, cells), supports, law, moved);
  join_rims(result, cells, supports);
  for (std::uint32_t k = 0; law == PlateLaw::membrane && k < cells.positions.size(); ++k)
    result.constraints.fix(dof(k, 0));
  result.constraints.resolve();
  return result;
}

}  // namespace plate
