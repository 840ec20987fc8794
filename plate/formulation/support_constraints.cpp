#include "plate/formulation/support_constraints.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/patch.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/errors.hpp"
#include "plate/model/load_integration.hpp"
#include "plate/model/problem.hpp"
#include "plate/model/reduction.hpp"
#include "plate/model/space.hpp"

namespace plate {

using geometry::Point;

bool SupportOffsets::moves(const SupportMotion& motion, const Side& side) const {
  const auto number = holder(boundary_->holders, side.name);
  return number < boundary_->holders.size() && boundary_->holders[number].support == motion.settlement.support;
}

PointValues SupportOffsets::at(const SupportMotion& motion, const Point& lattice, const Side& side) const {
  const auto& units = boundary_->cloud.units;
  return motion.at(units.from_lattice(lattice), side.outward(lattice), -side.inside(lattice) * units.spacing);
}

SupportOffsets::Offsets SupportOffsets::of(const Dof& dof, const Side& side, const Leaders& leaders) const {
  Offsets result;
  for (const auto& motion : motions_) {
    if (!moves(motion, side)) continue;
    const auto value = [&](const Dof& one) { return at(motion, boundary_->lattice[one.point], side)[one.component]; };
    double offset = value(dof);
    for (const auto& [leader, factor] : leaders) offset -= factor * value(leader);
    result.push_back({motion.load, offset});
  }
  double of_gap = 1;
  for (const auto& leader : leaders) of_gap -= is_deflection(leader.dof) ? leader.factor : 0;
  if (side.kind == SupportKind::simply_supported) add_gap(holder(boundary_->holders, side.name), dof, of_gap, result);
  return result;
}

void SupportOffsets::add_gap(std::uint32_t holder, const Dof& dof, double value, Offsets& offsets) const {
  if (boundary_->holders[holder].push != Push::both_ways && is_deflection(dof))
    offsets.push_back({gap(dof.point), value});
}

SupportOffsets::Offsets SupportOffsets::of_corner(std::uint32_t image, std::uint32_t point, std::uint32_t component,
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

SupportOffsets::Offsets SupportOffsets::inside(std::size_t support, const Point& x, std::uint32_t component) const {
  Offsets result;
  for (const auto& motion : motions_)
    if (motion.settlement.support == support) result.push_back({motion.load, motion.at(x)[component]});
  return result;
}

namespace {

void hold_line(Boundary& boundary, const geometry::Polyline& along, std::uint32_t holder, const SupportOffsets& moved) {
  const auto& cloud = boundary.cloud;
  std::map<std::size_t, std::pair<Point, double>> feet;  // of every point: sum of places times lengths, of lengths
  for (const auto& [k, middle, way] : line_pieces(along, cloud, {})) {
    auto& [sum, length] = feet.try_emplace(k, Point(0, 0), 0.0).first->second;
    sum += way.norm() * middle, length += way.norm();
  }
  for (const auto& [point, foot] : feet)
    hold_place(boundary, std::uint32_t(point), foot.first / foot.second, holder, moved);
}

/// Points that lie on the boundary of a part belong to it.
void hold_part(Boundary& boundary, const geometry::Hole& shape, std::uint32_t holder, const SupportOffsets& moved) {
  constexpr double nothing = 1e-6;  // spacings
  const auto& cloud = boundary.cloud;
  const auto* circle = std::get_if<geometry::Circle>(&shape);
  const auto ring = geometry::Patch(shape).ring();
  geometry::Polyline around = ring;
  around.push_back(ring.front());
  const geometry::Outline part{{ring, std::vector<std::string>(ring.size())}, {}};
  const double rim = nothing * cloud.units.spacing;
  const auto holds = [&](const Point& x) {
    if (circle) return (x - circle->centre).norm() <= circle->radius + rim;
    return geometry::contains(part, x) || geometry::distance(around, x) <= rim;
  };
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < cloud.plate_points; ++k)
    if (holds(cloud.positions[k])) hold_point(boundary, k, holder, moved), ++count;
  const bool any = cloud.part ? largest_of(boundary.map, count > 0) > 0 : count > 0;
  if (!any)
    throw Refused({{Subject::support_patch, boundary.holders[holder].support,
                    fmt::format("no point of the plate lies on it at spacing {:g}: refine, or give points",
                                cloud.units.spacing)}});
}

/// Adds places at most `spacing` apart from one end of a line to the other.
void add_places(const geometry::Polyline& line, double spacing, std::vector<Point>& places) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point way = line[i + 1] - line[i];
    const int parts = std::max(1, int(std::ceil(way.norm() / spacing - 1e-6)));
    for (int n = i == 0 ? 0 : 1; n <= parts; ++n) places.push_back(line[i] + way * n / parts);
  }
}

/// The boundary of a part; circles by chords of a spacing, corners of polygons kept.
geometry::Polyline around(const geometry::Hole& shape, double spacing) {
  geometry::Polyline ring;
  if (const auto* circle = std::get_if<geometry::Circle>(&shape)) {
    const double full = 2 * std::acos(-1.0);
    const int parts = std::max(6, int(std::ceil(full * circle->radius / spacing)));
    for (int n = 0; n < parts; ++n)
      ring.push_back(circle->centre + circle->radius * Point(std::cos(full * n / parts), std::sin(full * n / parts)));
  } else {
    ring = geometry::Patch(shape).ring();
  }
  ring.push_back(ring.front());
  return ring;
}

}  // namespace

std::vector<std::uint32_t> held_at_point(SupportKind kind) {
  switch (kind) {
    case SupportKind::clamped:
      return {0, 1, 2};
    case SupportKind::u_alone:
      return {0, 2};
    case SupportKind::v_alone:
      return {0, 1};
    default:
      return {0};
  }
}

void hold_point(Boundary& boundary, std::uint32_t point, std::uint32_t holder, const SupportOffsets& moved) {
  const auto& by = boundary.holders[holder];
  const auto held = held_at_point(by.kind);
  for (const auto c : held) {
    auto offsets = moved.inside(by.support, boundary.cloud.positions[point], c);
    moved.add_gap(holder, dof(point, c), 1, offsets);
    boundary.constraints.fix(dof(point, c), std::move(offsets));
  }
  boundary.holds.push_back({point, holder, false});
  if (held.size() > 1) boundary.holds.push_back({point, holder, true});
}

void hold_place(Boundary& boundary, std::uint32_t k, const Point& at, std::uint32_t holder,
                const SupportOffsets& moved) {
  constexpr double nothing = 1e-9;  // spacings
  const Point lever = at - boundary.cloud.positions[k];
  const auto& by = boundary.holders[holder];
  if (held_at_point(by.kind).size() > 1 || lever.norm() < nothing * boundary.cloud.units.spacing)
    return hold_point(boundary, k, holder, moved);
  auto offsets = moved.inside(by.support, at, 0);
  moved.add_gap(holder, dof(k, 0), 1, offsets);
  boundary.constraints.tie(dof(k, 0), {{dof(k, 1), -lever.y()}, {dof(k, 2), lever.x()}}, std::move(offsets));
  boundary.holds.push_back({k, holder, false});
}

void hold_inside(Boundary& boundary, const std::vector<Support>& supports, const SupportOffsets& moved) {
  for (std::uint32_t i = 0; i < boundary.holders.size(); ++i) {
    const bool hub = boundary.holders[i].kind == SupportKind::hub;  // hold_hubs()
    if (boundary.holders[i].place != Holder::Place::inside || hub) continue;
    const auto& support = supports[boundary.holders[i].support];
    if (support.patch)
      hold_part(boundary, *support.patch, i, moved);
    else
      hold_line(boundary, support.along, i, moved);
  }
}

std::vector<Point> places_inside(const std::vector<Support>& supports, const geometry::Outline& outline,
                                 const std::vector<geometry::CrackPath>& cracks, double spacing) {
  std::vector<Point> all, result;
  for (const auto& support : supports) {
    if (support.patch) add_places(around(*support.patch, spacing), spacing, all);
    add_places(support.along, spacing, all);
  }
  for (const auto& x : all) {
    const bool near =
        geometry::distance_to_boundary(outline, x) < spacing / 2 || std::ranges::any_of(cracks, [&](const auto& crack) {
          return geometry::distance(crack.vertices, x) < spacing / 2;
        });
    if (!near && geometry::contains(outline, x)) result.push_back(x);
  }
  return result;
}

namespace {

/// The places of own_places() but for those of supports on lines and parts.
std::vector<Point> places_of_points(const Problem& c) {
  std::vector<Point> points;
  for (const auto& support : c.supports) points.insert(points.end(), support.points.begin(), support.points.end());
  for (const auto& load : c.loads)
    if (const auto x = load.point()) points.push_back(*x);
  for (const auto& spring : c.springs)
    if (spring.position) points.push_back(*spring.position);
  if (c.impact) points.push_back(c.impact->position);
  return points;
}

}  // namespace

std::vector<geometry::Circle> parting_discs(const Problem& c, const std::vector<geometry::CrackPath>& paths,
                                            double spacing) {
  std::vector<geometry::Circle> discs;
  std::vector<Support> others;
  for (const auto& support : c.supports) {
    if (support.kind != SupportKind::hub || !support.patch) {
      others.push_back(support);
      continue;
    }
    const auto& [centre, radius, name] = std::get<geometry::Circle>(*support.patch);
    discs.push_back({centre, radius, "hub" + std::to_string(discs.size())});
  }
  auto places = places_of_points(c);
  for (const auto& x : places_inside(others, c.outline, paths, spacing)) places.push_back(x);
  std::vector<geometry::Circle> result;
  for (const auto& disc : discs) {
    const double clear = disc.radius + spacing / 2;
    const bool other = std::ranges::any_of(discs, [&](const auto& next) {
      return next.name != disc.name && (next.centre - disc.centre).norm() < clear + next.radius;
    });
    const bool crack = std::ranges::any_of(
        paths, [&](const auto& path) { return geometry::distance(path.vertices, disc.centre) < clear; });
    const bool place = std::ranges::any_of(
        places, [&](const Point& x) { return std::abs((x - disc.centre).norm() - disc.radius) < spacing / 2; });
    const bool inside = geometry::distance_to_boundary(c.outline, disc.centre) >= clear;
    if (inside && disc.radius >= spacing && !other && !crack && !place) result.push_back(disc);
  }
  return result;
}

geometry::CrackPath rim_path(const geometry::Circle& circle, double spacing) {
  return {around(circle, spacing), geometry::End::junction, geometry::End::junction};
}

std::vector<Point> own_places(const Problem& c, const std::vector<geometry::CrackPath>& paths, double spacing) {
  auto points = places_of_points(c);
  const auto parting = parting_discs(c, paths, spacing);
  auto supports = c.supports;
  std::erase_if(supports, [&](const Support& support) {
    const auto* disc = support.patch ? std::get_if<geometry::Circle>(&*support.patch) : nullptr;
    return disc && support.kind == SupportKind::hub && std::ranges::any_of(parting, [&](const auto& other) {
             return other.centre == disc->centre && other.radius == disc->radius;
           });
  });
  for (const auto& x : places_inside(supports, c.outline, paths, spacing)) points.push_back(x);
  return points;
}

}  // namespace plate
