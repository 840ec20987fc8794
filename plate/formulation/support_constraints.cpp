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

}  // namespace

std::vector<std::uint32_t> points_on(const geometry::Hole& shape, const geometry::Cloud& cloud) {
  constexpr double nothing = 1e-6;  // spacings
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
  std::vector<std::uint32_t> result;
  for (std::uint32_t k = 0; k < cloud.plate_points; ++k)
    if (holds(cloud.positions[k])) result.push_back(k);
  return result;
}

namespace {

void hold_part(Boundary& boundary, const geometry::Hole& shape, std::uint32_t holder, const SupportOffsets& moved) {
  const auto& cloud = boundary.cloud;
  const auto points = points_on(shape, cloud);
  for (const auto k : points) hold_point(boundary, k, holder, moved);
  const bool any = cloud.part ? largest_of(boundary.map, !points.empty()) > 0 : !points.empty();
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

/// The place where the neighbours a p and q d of a short edge p q meet, if it is no farther away than that edge is
/// long; else the middle of the edge.
Point instead_of_edge(const Point& a, const Point& p, const Point& q, const Point& d) {
  const auto cross = [](const Point& u, const Point& v) { return u.x() * v.y() - u.y() * v.x(); };
  const double turn = cross(p - a, d - q), length = (q - p).norm();
  const Point met = p + cross(q - p, d - q) / turn * (p - a);
  const bool near = turn != 0 && std::max((met - p).norm(), (met - q).norm()) <= length;
  return near ? met : (p + q) / 2;
}

/// Ring without edges shorter than `least` [length], of which one place remains, of the shortest first.
geometry::Polyline without_short_edges(geometry::Polyline ring, double least) {
  while (ring.size() > 3) {
    std::size_t shortest = 0;
    const auto next = [&](std::size_t i) { return (i + 1) % ring.size(); };
    const auto length = [&](std::size_t i) { return (ring[next(i)] - ring[i]).norm(); };
    for (std::size_t i = 1; i < ring.size(); ++i)
      if (length(i) < length(shortest)) shortest = i;
    if (length(shortest) >= least) break;
    const std::size_t end = next(shortest), before = (shortest + ring.size() - 1) % ring.size();
    ring[shortest] = instead_of_edge(ring[before], ring[shortest], ring[end], ring[next(end)]);
    ring.erase(ring.begin() + std::ptrdiff_t(end));
  }
  return ring;
}

/// The boundary of a part; circles by chords of a spacing, corners of polygons kept but where they are closer together
/// than half of that.
geometry::Polyline around(const geometry::Hole& shape, double spacing) {
  geometry::Polyline ring;
  if (const auto* circle = std::get_if<geometry::Circle>(&shape)) {
    const double full = 2 * std::acos(-1.0);
    const int parts = std::max(6, int(std::ceil(full * circle->radius / spacing)));
    for (int n = 0; n < parts; ++n)
      ring.push_back(circle->centre + circle->radius * Point(std::cos(full * n / parts), std::sin(full * n / parts)));
  } else {
    ring = without_short_edges(geometry::Patch(shape).ring(), spacing / 2);
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

bool is_body(const Support& support) {
  return support.patch && (support.kind == SupportKind::clamped || support.kind == SupportKind::hub);
}

namespace {

/// Boundary of a body, and places on it at most half of `spacing` apart.
struct Rim {
  geometry::Polyline ring;
  std::vector<Point> places = {};

  Rim(const geometry::Hole& shape, double spacing) : ring(around(shape, spacing)) {
    add_places(ring, spacing / 2, places);
  }
  bool contains(const Point& x) const {
    const geometry::Polyline open(ring.begin(), ring.end() - 1);
    return geometry::contains({{open, std::vector<std::string>(open.size())}, {}}, x);
  }
  /// Distance of a polyline or a ring from this one; 0 where it has a place within.
  double distance(const geometry::Polyline& other) const {
    double result = std::ranges::any_of(other, [&](const Point& x) { return contains(x); }) ? 0 : INFINITY;
    for (const auto& x : places) result = std::min(result, geometry::distance(other, x));
    for (const auto& x : other) result = std::min(result, geometry::distance(ring, x));
    return result;
  }
};

/// Shares 0 to 1 of a segment at which it meets the boundary of a plate, with both ends, ascending.
std::vector<double> cuts(const geometry::Outline& outline, const Point& from, const Point& to) {
  std::vector<double> result{0, 1};
  const auto add = [&](double share) {
    if (share > 0 && share < 1) result.push_back(share);
  };
  const auto cross = [](const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); };
  const Point way = to - from;
  for (const auto& edge : geometry::straight_edges(outline)) {
    const Point along = edge.to - edge.from, apart = edge.from - from;
    const double turn = cross(way, along);
    if (turn == 0) continue;
    if (const double share = cross(apart, way) / turn; share >= 0 && share <= 1) add(cross(apart, along) / turn);
  }
  for (const auto& circle : geometry::circles(outline)) {
    const Point apart = from - circle.centre;
    const double a = way.squaredNorm(), b = apart.dot(way), c = apart.squaredNorm() - circle.radius * circle.radius;
    if (const double root = b * b - a * c; root > 0)
      for (const double sign : {-1, 1}) add((-b + sign * std::sqrt(root)) / a);
  }
  std::ranges::sort(result);
  return result;
}

/// The parts of a closed ring that lie within a plate: the ring itself, or pieces from mouth to mouth.
std::vector<geometry::CrackPath> pieces_inside(const geometry::Polyline& ring, const geometry::Outline& outline,
                                               double nothing) {
  using enum geometry::End;
  std::vector<geometry::CrackPath> result;
  bool open = false, whole = true;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const auto shares = cuts(outline, ring[i], ring[i + 1]);
    const auto at = [&](double share) -> Point { return ring[i] + share * (ring[i + 1] - ring[i]); };
    for (std::size_t n = 0; n + 1 < shares.size(); ++n) {
      const Point from = at(shares[n]), to = at(shares[n + 1]), middle = (from + to) / 2;
      if ((to - from).norm() < nothing) continue;
      const bool inside =
          geometry::contains(outline, middle) && geometry::distance_to_boundary(outline, middle) > nothing;
      if (inside && open && geometry::distance_to_boundary(outline, from) <= nothing) open = whole = false;
      if (inside && !open) result.push_back({{from}, mouth, mouth});
      if (inside) result.back().vertices.push_back(to);
      open = inside, whole = whole && inside;
    }
  }
  if (whole && result.size() == 1) return {{ring, junction, junction}};
  const auto ends_inside = [&](const Point& x) { return geometry::distance_to_boundary(outline, x) > nothing; };
  if (result.size() > 1 && ends_inside(result.front().vertices.front())) {  // the first goes on from the last
    auto& last = result.back().vertices;
    last.insert(last.end(), result.front().vertices.begin() + 1, result.front().vertices.end());
    result.erase(result.begin());
  }
  return result;
}

/// True where a path keeps half of `spacing` from the boundary, but for its mouths, which it leaves at 30 degrees or
/// more.
bool clear_of_boundary(const geometry::CrackPath& path, const geometry::Outline& outline, double spacing) {
  std::vector<Point> places;
  add_places(path.vertices, spacing / 2, places);
  return std::ranges::all_of(places, [&](const Point& x) {
    const double away = std::min((x - path.vertices.front()).norm(), (x - path.vertices.back()).norm());
    const double wanted = path.front == geometry::End::mouth ? std::min(spacing, away) / 2 : spacing / 2;
    return geometry::distance_to_boundary(outline, x) >= (1 - 1e-9) * wanted;
  });
}

/// True where a body is as wide as two points.
bool resolved(const geometry::Hole& shape, double spacing) {
  if (const auto* circle = std::get_if<geometry::Circle>(&shape)) return circle->radius >= spacing;
  const auto ring = around(shape, spacing);
  double round = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) round += (ring[i + 1] - ring[i]).norm();
  const double area = std::abs(geometry::moments({ring.begin(), ring.end() - 1}, ring.front()).area);
  return 2 * area >= spacing * round;
}

}  // namespace

std::vector<PartedBody> parted_bodies(const Problem& c, const std::vector<geometry::CrackPath>& paths, double spacing) {
  std::vector<std::size_t> bodies;
  std::vector<Rim> rims;
  std::vector<Support> others;
  for (std::size_t i = 0; i < c.supports.size(); ++i)
    if (const auto& support = c.supports[i]; is_body(support))
      bodies.push_back(i), rims.emplace_back(*support.patch, spacing);
    else
      others.push_back(support);
  auto places = places_of_points(c);
  for (const auto& x : places_inside(others, c.outline, paths, spacing)) places.push_back(x);
  const double clear = spacing / 2;
  std::vector<PartedBody> result;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const auto& rim = rims[n];
    const auto& shape = *c.supports[bodies[n]].patch;
    const PartedBody body{.support = bodies[n], .shape = shape};
    const auto inside = body.rims(c.outline, spacing);
    const bool open = !inside.empty() && std::ranges::all_of(inside, [&](const auto& path) {
      return clear_of_boundary(path, c.outline, spacing);
    });
    const bool other = std::ranges::any_of(rims, [&](const Rim& next) {
      return &next != &rim && (rim.distance(next.ring) < clear || next.distance(rim.ring) < clear);
    });
    const bool crack =
        std::ranges::any_of(paths, [&](const auto& path) { return rim.distance(path.vertices) < clear; });
    const bool place =
        std::ranges::any_of(places, [&](const Point& x) { return geometry::distance(rim.ring, x) < clear; });
    if (open && resolved(shape, spacing) && !other && !crack && !place) result.push_back(body);
  }
  return result;
}

std::string PartedBody::name() const {
  return fmt::format("rim of support {}", support);
}

std::vector<geometry::CrackPath> PartedBody::rims(const geometry::Outline& outline, double spacing) const {
  return pieces_inside(around(shape, spacing), outline, 1e-6 * spacing);
}

bool PartedBody::on_rim(const Point& x, double spacing, double beside) const {
  return geometry::distance(around(shape, spacing), x) < beside;
}

std::vector<Point> own_places(const Problem& c, const std::vector<geometry::CrackPath>& paths, double spacing) {
  auto points = places_of_points(c);
  std::vector<Support> supports;
  const auto parted = parted_bodies(c, paths, spacing);
  for (std::size_t i = 0; i < c.supports.size(); ++i)
    if (std::ranges::find(parted, i, &PartedBody::support) == parted.end()) supports.push_back(c.supports[i]);
  for (const auto& x : places_inside(supports, c.outline, paths, spacing)) points.push_back(x);
  return points;
}

}  // namespace plate
