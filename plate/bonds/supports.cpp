#include "plate/bonds/supports.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "geometry/lattice/cloud.hpp"
#include "plate/formulation/hubs.hpp"
#include "plate/formulation/support_constraints.hpp"
#include "plate/model/space.hpp"

namespace plate {
namespace {

using geometry::Point;

/// True of the kinds that hold w and both rotations, or move them as one body.
bool clamps(SupportKind kind) {
  return kind == SupportKind::clamped || kind == SupportKind::hub;
}

bool has_images(SupportKind kind) {
  using enum SupportKind;
  return clamps(kind) || kind == simply_supported_hard || kind == symmetry;
}

/// +1 or -1 for w, theta_x, theta_y across an edge with the given normal axis.
std::array<int, unknowns_per_point> parity(SupportKind kind, int normal_axis) {
  if (clamps(kind)) return {-1, -1, -1};
  const int normal_rotation = normal_axis == 0 ? 2 : 1;  // psi_n is -theta_y or theta_x
  std::array<int, unknowns_per_point> signs{1, 1, 1};
  if (kind == SupportKind::symmetry) {
    signs[static_cast<std::size_t>(normal_rotation)] = -1;
  } else {
    signs = {-1, -1, -1};
    signs[static_cast<std::size_t>(normal_rotation)] = 1;
  }
  return signs;
}

/// +1 or -1 for w across an edge whose images have no bonds.
int parity_of_deflection(SupportKind kind) {
  return kind == SupportKind::free || kind == SupportKind::symmetry ? 1 : -1;
}

/// True where the plate goes on beyond the side as images, or does so in its plane where that has the same points.
bool has_points_beyond(const Side& side) {
  return has_images(side.kind) || has_images(side.other);
}

/// True where the outline turns left from the end of one edge into the other.
bool convex_corner(const Side& first, const Side& second) {
  if (first.circle || second.circle || first.edge.to != second.edge.from) return false;
  const Point a = first.edge.to - first.edge.from, b = second.edge.to - second.edge.from;
  return a.x() * b.y() - a.y() * b.x() > 0;
}

/// Motions of the bodies that hold parts of a plate, by their holders.
using Bodies = std::map<std::uint32_t, BodyMotion>;

/// Builds the fictitious points and ties of one plate.
class Builder {
public:
  Builder(Boundary& target, const SupportOffsets& moved, Bodies bodies, double reach, double spacing)
      : b_(target),
        moved_(moved),
        bodies_(std::move(bodies)),
        reach_(reach * (1 + 1e-9)),
        spacing_(spacing),
        cells_(target.lattice) {}

  void mirror_images();
  void general_images();
  void outermost_rows();
  void layers();

private:
  void add(const Point& u, double area, FictitiousPoint what) {
    b_.cloud.positions.push_back(b_.cloud.units.from_lattice(u));
    b_.cloud.areas.push_back(area);
    b_.lattice.push_back(u);
    b_.fictitious.push_back(what);
  }
  std::uint32_t last() const { return static_cast<std::uint32_t>(b_.lattice.size() - 1); }
  /// Constrains a degree of freedom that a side holds: tie() to those that it follows, fix() to none.
  void tie(const Dof& dof, const Side& side, const SupportOffsets::Leaders& leaders) {
    if (const auto body = bodies_.find(holder(b_.holders, side)); side.support && body != bodies_.end())
      tie_to_body(b_.constraints, dof, beside(body->second, dof, leaders));
    else
      b_.constraints.tie(dof, leaders, moved_.of(dof, side, leaders));
  }
  void fix(const Dof& dof, const Side& side) { b_.constraints.fix(dof, moved_.of(dof, side, {})); }
  BodyValue beside(const BodyMotion& motion, const Dof& dof, const SupportOffsets::Leaders& leaders) const;
  /// True where a point of the plate is no part of a body.
  bool alone(std::uint32_t k) const { return b_.body_of(k) < 0; }
  bool beyond(const Side& side, const Point& v) const;
  void tie_image(std::uint32_t leader, const std::array<double, unknowns_per_point>& factors, const Side& side) {
    for (std::uint32_t c = 0; c < unknowns_per_point; ++c) tie(dof(last(), c), side, {{dof(leader, c), factors[c]}});
  }
  void lead_clamped(std::array<SupportOffsets::Leaders, unknowns_per_point>& leaders, std::uint32_t k, double share,
                    double depth, double inside, const Point& out, const Point& away) const;
  void tie_clamped(std::uint32_t leader, double depth, double inside, const Side& side);
  std::vector<std::pair<std::uint32_t, double>> shares_around(const Side& side, const Point& x) const;
  bool tie_clamped_between(const Point& u, double depth, const Side& side);
  void tie_without_bonds(std::uint32_t leader, double depth, const Side& side);
  bool within(const Side& side, const Point& u) const;
  void mirror_at_corners();
  void follow(std::uint32_t k, const Side& side);
  void outside_cell(const Point& u, int s);

  Boundary& b_;
  const SupportOffsets& moved_;
  Bodies bodies_;
  double reach_, spacing_;
  geometry::CellIndex cells_;
};

/// Value of a degree of freedom that follows leaders by the difference of each from the motion of a body.
BodyValue Builder::beside(const BodyMotion& motion, const Dof& dof, const SupportOffsets::Leaders& leaders) const {
  const auto at = [&](const plate::Dof& one) { return motion(b_.cloud.positions[one.point], one.component); };
  auto result = at(dof);
  for (const auto& leader : leaders) {
    auto of_body = at(leader.dof);
    for (auto& [dof_of_body, factor] : of_body.leaders)
      result.leaders.push_back({dof_of_body, -leader.factor * factor});
    for (auto& [load, value] : of_body.offsets) result.offsets.push_back({load, -leader.factor * value});
    result.leaders.push_back(leader);
  }
  return result;
}

/// True where the place of a cell lies beyond a side: of an outline outside the plate, of a rim in its part.
bool Builder::beyond(const Side& side, const Point& v) const {
  if (side.inside(v) > 0) return false;
  const auto k = cells_.at(v);
  return side.support ? k && b_.body[*k] == std::int32_t(*side.support) : !k;
}

bool Builder::within(const Side& side, const Point& u) const {
  const double d = side.inside(u);
  if (d <= 0 || d > reach_) return false;
  const Point along = (side.edge.to - side.edge.from).normalized();
  const double s = along.dot(u - side.edge.from), length = (side.edge.to - side.edge.from).norm();
  return s > -reach_ && s < length + reach_;
}

/// Adds a point k as a leader, with this share, of a point at `depth` d beyond a clamped line: rotations -d/d', and w =
/// -(d/d') w' + (d^2 + d d')/(2 d') psi_n', psi_n along the inner normal, w' and psi' at the place d' = `inside` that
/// lies `away` [length] from k, w' = w_k + away . psi_k / 2: exact for constant curvature and for constant shear from
/// the line on. Plain odd w would see a spurious shear there.
void Builder::lead_clamped(std::array<SupportOffsets::Leaders, unknowns_per_point>& leaders, std::uint32_t k,
                           double share, double depth, double inside, const Point& out, const Point& away) const {
  const double ratio = depth / inside, lever = spacing_ * depth * (depth + inside) / (2 * inside);
  const Point arm = lever * out + ratio / 2 * away;  // psi_n = out_x theta_y - out_y theta_x
  leaders[0].push_back({dof(k, 0), -share * ratio});
  leaders[0].push_back({dof(k, 1), -share * arm.y()});
  leaders[0].push_back({dof(k, 2), share * arm.x()});
  for (std::uint32_t c = 1; c < unknowns_per_point; ++c) leaders[c].push_back({dof(k, c), -share * ratio});
}

/// Ties the last point, at `depth` beyond a clamped line, to one leader at `inside`.
void Builder::tie_clamped(std::uint32_t leader, double depth, double inside, const Side& side) {
  std::array<SupportOffsets::Leaders, unknowns_per_point> leaders;
  lead_clamped(leaders, leader, 1, depth, inside, side.outward(b_.lattice[leader]), {0, 0});
  for (std::uint32_t c = 0; c < unknowns_per_point; ++c) tie(dof(last(), c), side, leaders[c]);
}

/// Clamped lines off the lattice act as if they lay this far out [spacings]: images are taken about a line that far in.
/// Points beside a rim have whole cells, those beside an edge what lies in the plate. Measured at 10 to 45 degrees,
/// horizon ratios 2 to 5, nu 0 to 0.45, thicknesses of 1 to 20 spacings (tests/verification, "General images").
double line_further_in(const Side& side) {
  return side.support ? 0.05 : 0.02;
}

/// Points of the plate around a place, on this side of a line, whose values give that at the place by their shares:
/// bilinear of four, linear of three where the plate does not have the fourth. Empty where it has fewer.
std::vector<std::pair<std::uint32_t, double>> Builder::shares_around(const Side& side, const Point& x) const {
  constexpr double nothing = 1e-9;
  const Point low(std::floor(x.x() - 0.5) + 0.5, std::floor(x.y() - 0.5) + 0.5);
  std::vector<std::pair<std::uint32_t, double>> result;
  std::optional<Point> missing;
  for (int corner = 0; corner < 4; ++corner) {
    const Point cell = low + Point(corner % 2, corner / 2), d = (x - cell).cwiseAbs();
    const double share = (1 - d.x()) * (1 - d.y());
    if (share < nothing) continue;
    const auto k = cells_.at(cell);
    if (k && alone(*k) && side.inside(b_.lattice[*k]) > 0)
      result.emplace_back(*k, share);
    else if (missing)
      return {};
    else
      missing = cell;
  }
  if (!missing) return result;
  const Point opposite = 2 * low + Point(1, 1) - *missing, d = (x - opposite).cwiseAbs();
  if (d.x() + d.y() > 1) return {};
  for (auto& [k, share] : result) {
    const Point from = (b_.lattice[k] - opposite).cwiseAbs();
    share = from.x() + from.y() < 0.5 ? 1 - d.x() - d.y() : from.dot(d);
  }
  return result;
}

/// Ties the last point u, at `depth` beyond a clamped side, to its mirror position or, where that lies less than a
/// quarter of a spacing inside or has no points of the plate around it, to the next place further in. Returns false
/// where there is none within 1.5 spacings.
bool Builder::tie_clamped_between(const Point& u, double depth, const Side& side) {
  constexpr double least = 0.25, step = 0.125, further = 1.5;  // spacings
  const Point out = side.outward(u), foot = u - depth * out;
  const double further_in = line_further_in(side);
  for (double inside = std::max(depth, least); inside <= depth + further; inside += step) {
    const Point x = foot - inside * out;
    std::array<SupportOffsets::Leaders, unknowns_per_point> leaders;
    for (const auto& [k, share] : shares_around(side, x))
      lead_clamped(leaders, k, share, depth + further_in, inside - further_in, out, spacing_ * (x - b_.lattice[k]));
    if (leaders[0].empty()) continue;
    for (std::uint32_t c = 0; c < unknowns_per_point; ++c) tie(dof(last(), c), side, leaders[c]);
    return true;
  }
  return false;
}

/// Ties the deflection of a point beyond a line to which the plate has no bonds, but its plane has: odd where the line
/// is held, else along the rotation of the leader.
void Builder::tie_without_bonds(std::uint32_t leader, double depth, const Side& side) {
  const Point& u = b_.lattice[leader];
  const Point d = spacing_ * (b_.lattice[last()] - u);
  if (parity_of_deflection(side.kind) > 0)
    tie(dof(last(), 0), side, {{dof(leader, 0), 1}, {dof(leader, 1), d.y()}, {dof(leader, 2), -d.x()}});
  else
    tie(dof(last(), 0), side, {{dof(leader, 0), -depth / side.inside(u)}});
  for (std::uint32_t c = 1; c < unknowns_per_point; ++c) fix(dof(last(), c), side);
}

void Builder::mirror_images() {
  for (std::size_t s = 0; s < b_.sides.size(); ++s) {
    const Side& side = b_.sides[s];
    if (!has_points_beyond(side) || !side.along_lattice()) continue;
    const auto signs = parity(side.kind, side.normal_axis());
    for (std::uint32_t k = 0; k < b_.cloud.plate_points; ++k) {
      if (!within(side, b_.lattice[k]) || !alone(k)) continue;
      const bool bonded = has_images(side);
      add(side.mirrored(b_.lattice[k]), b_.cloud.areas[k], {{static_cast<int>(s), -1}, false, true, bonded});
      if (!bonded)
        tie_without_bonds(k, side.inside(b_.lattice[k]), side);
      else if (clamps(side.kind))
        tie_clamped(k, side.inside(b_.lattice[k]), side.inside(b_.lattice[k]), side);
      else
        tie_image(k, {double(signs[0]), double(signs[1]), double(signs[2])}, side);
    }
  }
  mirror_at_corners();
}

/// Convex right-angled corners between two mirrors: the image of the image.
void Builder::mirror_at_corners() {
  for (std::size_t s = 0; s < b_.sides.size(); ++s)
    for (std::size_t t = 0; t < b_.sides.size(); ++t) {
      const Side &first = b_.sides[s], &second = b_.sides[t];
      const bool both =
          has_points_beyond(first) && has_points_beyond(second) && first.along_lattice() && second.along_lattice();
      if (!both || !convex_corner(first, second)) continue;
      const bool bonded = has_images(first) && has_images(second);
      auto p = parity(first.kind, first.normal_axis()), q = parity(second.kind, second.normal_axis());
      if (!bonded) p[0] = parity_of_deflection(first.kind), q[0] = parity_of_deflection(second.kind);
      for (std::uint32_t k = 0; k < b_.cloud.plate_points; ++k) {
        if (!within(first, b_.lattice[k]) || !within(second, b_.lattice[k])) continue;
        add(second.mirrored(first.mirrored(b_.lattice[k])), b_.cloud.areas[k],
            {{static_cast<int>(s), static_cast<int>(t)}, false, true, bonded});
        for (std::uint32_t c = 0; c < unknowns_per_point; ++c)
          b_.constraints.tie(dof(last(), c), {{dof(k, c), double(p[c] * q[c])}},
                             moved_.of_corner(last(), k, c, first, p[c], second, q[c]));
      }
    }
}

/// Sides that mirror but do not lie along the lattice: lattice points outside, next to the side. Where two sides see
/// one place each has its own image of it: a bond meets the one of the side through which it leaves.
void Builder::general_images() {
  const auto window = static_cast<long>(std::ceil(reach_));
  for (std::size_t s = 0; s < b_.sides.size(); ++s) {
    const Side& side = b_.sides[s];
    if (!has_points_beyond(side) || side.along_lattice()) continue;
    std::set<std::pair<long, long>> outside;  // twice their coordinates
    for (std::uint32_t k = 0; k < b_.cloud.plate_points; ++k) {
      const Point& u = b_.lattice[k];
      if (!alone(k) || side.inside(u) > reach_ || (!side.circle && !within(side, u))) continue;
      for (long y = -window; y <= window; ++y)
        for (long x = -window; x <= window; ++x) {
          const Point v = u + Point(double(x), double(y));
          if ((v - u).norm() <= reach_ && beyond(side, v) && side.meets(u, v))
            outside.insert({std::lround(2 * v.x()), std::lround(2 * v.y())});
        }
    }
    for (const auto& [x, y] : outside) outside_cell(Point(double(x) / 2, double(y) / 2), static_cast<int>(s));
  }
}

void Builder::outside_cell(const Point& u, int s) {
  const Side& side = b_.sides[static_cast<std::size_t>(s)];
  const double depth = std::max(-side.inside(u), 0.0);
  add(u, spacing_ * spacing_, {{s, -1}, false, false, has_images(side)});
  if (clamps(side.kind) && tie_clamped_between(u, depth, side)) return;
  const Point image = u - 2 * depth * side.outward(u);
  std::optional<std::uint32_t> leader;
  double best = 4;  // cells around the image
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      const auto k = cells_.at(image + Point(x, y));
      if (!k || !alone(*k) || side.inside(b_.lattice[*k]) < std::max(0.25, depth / 2)) continue;
      const double away = (b_.lattice[*k] - image).norm();
      if (away < best) best = away, leader = k;
    }
  if (!leader) {
    for (std::uint32_t c = 0; c < unknowns_per_point; ++c) tie(dof(last(), c), side, {});
    return;
  }
  if (!has_images(side)) return tie_without_bonds(*leader, depth, side);
  if (clamps(side.kind)) {
    const double further_in = line_further_in(side);
    tie_clamped(*leader, depth + further_in, side.inside(b_.lattice[*leader]) - further_in, side);
    return;
  }
  const auto signs = parity(side.kind, side.normal_axis());
  const double ratio = depth / side.inside(b_.lattice[*leader]);
  std::array<double, unknowns_per_point> factors{};
  for (std::size_t c = 0; c < unknowns_per_point; ++c) factors[c] = signs[c] > 0 ? 1 : -ratio;
  tie_image(*leader, factors, side);
}

void Builder::outermost_rows() {
  for (const Side& side : b_.sides) {
    if (side.kind != SupportKind::simply_supported) continue;
    for (std::uint32_t k = 0; k < b_.cloud.plate_points; ++k)
      if (side.inside(b_.lattice[k]) < 1.5) follow(k, side);
  }
}

/// w of a point in the outermost row: w = 0 on the line, linear between.
void Builder::follow(std::uint32_t k, const Side& side) {
  const Point& u = b_.lattice[k];
  const Point normal = side.outward(u);
  Point step(0, 0);
  step[std::abs(normal.x()) >= std::abs(normal.y()) ? 0 : 1] = 1;
  if (step.dot(normal) < 0) step = -step;
  const bool outermost = side.circle ? (u + step - side.centre).norm() <= side.radius
                                     : geometry::meet(u, u + step, side.edge.from, side.edge.to);
  if (!outermost) return;
  b_.holds.push_back({k, holder(b_.holders, side.name), false});
  const auto inner = cells_.at(u - step);
  const double own = side.inside(u), further = inner ? side.inside(b_.lattice[*inner]) : 0;
  if (inner && further > own)
    tie(dof(k, 0), side, {{dof(*inner, 0), own / further}});
  else
    fix(dof(k, 0), side);
}

/// Strips one horizon wide outside the plate, with the corner squares between two of them.
void Builder::layers() {
  std::map<std::pair<long, long>, std::vector<int>> cells;
  for (std::size_t s = 0; s < b_.sides.size(); ++s) {
    const Side& side = b_.sides[s];
    if (!is_layer(side.kind) && !is_layer(side.other)) continue;
    Point low = side.edge.from.cwiseMin(side.edge.to), high = side.edge.from.cwiseMax(side.edge.to);
    const Point out = side.outward(low) * std::floor(reach_);
    low = low.cwiseMin(low + out), high = high.cwiseMax(high + out);
    for (const Side& other : b_.sides)
      if ((is_layer(other.kind) || is_layer(other.other)) &&
          (convex_corner(side, other) || convex_corner(other, side))) {
        const Point more = other.outward(low) * std::floor(reach_);
        low = low.cwiseMin(low + more), high = high.cwiseMax(high + more);
      }
    for (double y = std::floor(low.y()) + 0.5; y < high.y(); ++y)
      for (double x = std::floor(low.x()) + 0.5; x < high.x(); ++x)
        if (x > low.x() && y > low.y() && !cells_.at(Point(x, y)))
          cells[{std::lround(2 * x), std::lround(2 * y)}].push_back(static_cast<int>(s));
  }
  for (const auto& [key, list] : cells) {
    add(Point(double(key.first) / 2, double(key.second) / 2), spacing_ * spacing_,
        {{list[0], list.size() > 1 ? list[1] : -1},
         true,
         false,
         is_layer(b_.sides[static_cast<std::size_t>(list[0])].kind)});
    for (const int s : list) {
      const Side& side = b_.sides[static_cast<std::size_t>(s)];
      if (!is_layer(side.kind))
        for (std::uint32_t c = 0; c < unknowns_per_point; ++c) fix(dof(last(), c), side);
      fix(dof(last(), 0), side);
      if (side.kind == SupportKind::clamped_layer) fix(dof(last(), 1), side), fix(dof(last(), 2), side);
      if (side.kind == SupportKind::simply_supported_hard_layer)
        fix(dof(last(), side.normal_axis() == 0 ? 1 : 2), side);
    }
  }
}

void hold_pins(Boundary& b, const SupportOffsets& moved) {
  for (std::uint32_t pin = 0; pin < b.holders.size(); ++pin)
    if (const auto& at = b.holders[pin].position; at && b.cloud.seeded(*at))
      hold_place(b, static_cast<std::uint32_t>(geometry::nearest_plate_point(b.cloud, *at)), *at, pin, moved);
}

/// Adds one warning for all sides, of many the first three by name.
void warn_of_general_images(Boundary& boundary) {
  constexpr int most = 3;  // names
  std::string names;
  int sides = 0;
  for (const auto& side : boundary.sides)
    if (has_images(side) && !side.support && !side.along_lattice() && ++sides <= most)
      names += (names.empty() ? "'" : ", '") + side.name + "'";
  if (sides == 0) return;
  if (sides > most) names += " and " + std::to_string(sides - most) + " more";
  boundary.warnings.push_back((sides == 1 ? "edge " + names + " lies" : "edges " + names + " lie") +
                              " off the lattice's cell boundaries: images are less accurate there; set formulation = "
                              "\"galerkin\"");
}

}  // namespace

/// Bodies that hold parts of a plate, whose points are marked, and the rims of their parts among its sides. Those of
/// `others`, the supports of the same plate in its plane or across it, have rims too.
Bodies add_bodies(Boundary& b, const std::vector<Support>& supports, const std::vector<Support>& others,
                  const std::vector<Hub>& hubs, PlateLaw law, const SupportOffsets& moved) {
  Bodies result;
  for (std::uint32_t i = 0; i < b.holders.size(); ++i)
    if (const auto& by = b.holders[i]; is_body(supports[by.support]) && by.kind == SupportKind::clamped)
      result[i] = [&moved, number = by.support](const Point& at, std::uint32_t component) -> BodyValue {
        return {{}, moved.inside(number, at, component)};
      };
  for (const auto& hub : hubs) result[hub.holder] = motion_of(hub, b, supports, law, moved);
  if (result.empty() && std::ranges::none_of(others, is_body)) return result;
  b.body.assign(b.cloud.plate_points, -1);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const bool here = is_body(supports[i]), there = !others.empty() && is_body(others[i]);
    if (!here && !there) continue;
    for (const auto k : points_on(*supports[i].patch, b.cloud)) b.body[k] = std::int32_t(i);
    for (auto side : sides_of(geometry::to_lattice({{}, {*supports[i].patch}}, b.cloud.units), {})) {
      side.support = i;
      if (here) side.kind = supports[i].kind;
      if (there) side.other = others[i].kind;
      b.sides.push_back(std::move(side));
    }
  }
  return result;
}

bool has_images(const Side& side) {
  return has_images(side.kind);
}

Boundary boundary(geometry::Cloud cloud, const geometry::Outline& outline, const std::vector<Support>& supports,
                  const Discretization& discretization, const std::vector<SupportMotion>& motions, PointMap map,
                  PlateLaw law, const std::vector<Support>& others) {
  Boundary result;
  result.map = std::move(map);
  for (const auto& x : cloud.positions) result.lattice.push_back(cloud.units.to_lattice(x));
  result.cloud = std::move(cloud);
  result.sides = sides_of(outline, supports);
  if (!others.empty()) {
    const auto sides = sides_of(outline, others);
    for (std::size_t s = 0; s < sides.size(); ++s) result.sides[s].other = sides[s].kind;
  }
  result.holders = holders_of(supports);
  warn_of_general_images(result);
  const SupportOffsets moved(result, motions);
  hold_pins(result, moved);
  hold_inside(result, supports, moved);
  const auto hubs = hubs_of(supports, result.cloud);
  hold_hubs(result, hubs, supports, law, moved);
  Builder builder(result, moved, add_bodies(result, supports, others, hubs, law, moved), discretization.horizon_ratio,
                  discretization.spacing);
  builder.outermost_rows();
  builder.mirror_images();
  builder.general_images();
  builder.layers();
  for (std::uint32_t k = 0; law == PlateLaw::membrane && k < result.cloud.size(); ++k)
    result.constraints.fix(dof(k, 0));
  result.constraints.resolve();
  result.active.assign(result.cloud.size(), 1);
  for (std::size_t i = 0; i < result.fictitious.size(); ++i)
    result.active[result.cloud.plate_points + i] = result.fictitious[i].layer && result.fictitious[i].bonded;
  return result;
}

}  // namespace plate
