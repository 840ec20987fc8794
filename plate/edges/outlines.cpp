#include "plate/edges/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "geometry/lattice/cloud.hpp"
#include "plate/edges/oblique_edges.hpp"
#include "plate/model/errors.hpp"

namespace plate {

namespace {

using geometry::Edge;
using geometry::Point;

/// The axis of an edge's normal.
int normal_axis(const Edge& e) {
  return e.from.x() == e.to.x() ? 0 : 1;
}

/// Outward: the plate is on the left.
int side(const Edge& e) {
  return normal_axis(e) == 0 ? (e.to.y() > e.from.y() ? 1 : -1) : (e.to.x() > e.from.x() ? -1 : 1);
}

using EdgeRing = std::vector<Edge>;

/// Joins edges in one line; the edges follow one after the other, with the plate on the left.
EdgeRing joined(EdgeRing edges) {
  if (edges[0].to != edges[1].from) std::ranges::reverse(edges);
  const auto in_line = [](const Edge& a, const Edge& b) {
    return normal_axis(a) == normal_axis(b) && side(a) == side(b);
  };
  const auto corner = std::ranges::adjacent_find(edges, std::not_fn(in_line));
  std::ranges::rotate(edges, corner + 1);
  EdgeRing result;
  for (const Edge& e : edges)
    if (!result.empty() && in_line(result.back(), e))
      result.back().to = e.to;
    else
      result.push_back(e);
  return result;
}

std::vector<EdgeRing> rings(const geometry::Outline& outline) {
  const auto edges = geometry::straight_edges(outline);
  std::vector<EdgeRing> result;
  auto next = edges.begin();
  const auto take = [&](const geometry::Polygon& polygon) {
    const auto end = next + std::ptrdiff_t(polygon.vertices.size());
    result.push_back(joined({next, end}));
    next = end;
  };
  take(outline.outer);
  for (const auto& hole : outline.holes) take(std::get<geometry::Polygon>(hole));
  return result;
}

/// A corner, and into which quadrant its two edges run: of the plate where it is convex, else outside the plate.
struct Corner {
  Point at, quadrant;
  bool convex;
};

void look(Distance& least, double value, const Point& at) {
  if (value < least.value) least = {value, at};
}

/// Measures the distance between edges that run along each other with the plate, or the gap, between.
void look_between_edges(const EdgeRing& edges, Clearance& c) {
  for (const Edge& e : edges)
    for (const Edge& f : edges) {
      const int axis = normal_axis(e), along = 1 - axis;
      if (normal_axis(f) != axis || side(f) == side(e)) continue;
      const double low = std::max(std::min(e.from[along], e.to[along]), std::min(f.from[along], f.to[along])),
                   high = std::min(std::max(e.from[along], e.to[along]), std::max(f.from[along], f.to[along]));
      if (low >= high) continue;
      const double away = side(e) * (f.from[axis] - e.from[axis]);
      Point at;
      at[axis] = (e.from[axis] + f.from[axis]) / 2, at[along] = (low + high) / 2;
      look(away > 0 ? c.gap : c.width, std::abs(away), at);
    }
}

/// Measures the distance between corners that show each other their backs.
void look_between_corners(const std::vector<Corner>& corners, Clearance& c) {
  for (const Corner& p : corners)
    for (const Corner& q : corners) {
      const Point away = q.at - p.at;
      if (p.convex == q.convex && q.quadrant == -p.quadrant && (away.array() * p.quadrant.array() < 0).all())
        look(p.convex ? c.gap : c.width, away.norm(), p.at + away / 2);
    }
}

}  // namespace

bool is_rectilinear(const geometry::Outline& outline) {
  return std::ranges::all_of(outline.holes,
                             [](const auto& h) { return std::holds_alternative<geometry::Polygon>(h); }) &&
         std::ranges::all_of(geometry::straight_edges(outline),
                             [](const Edge& e) { return e.from.x() == e.to.x() || e.from.y() == e.to.y(); });
}

Clearance clearance(const geometry::Outline& outline) {
  Clearance result;
  EdgeRing all;
  std::vector<Corner> corners;
  for (const EdgeRing& ring : rings(outline))
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Edge &e = ring[i], &next = ring[(i + 1) % ring.size()];
      const Point before = (e.to - e.from).normalized(), after = (next.to - next.from).normalized();
      corners.push_back({e.to, after - before, before.x() * after.y() - before.y() * after.x() > 0});
      look(result.step, (e.to - e.from).norm(), (e.from + e.to) / 2);
      all.push_back(e);
    }
  look_between_edges(all, result);
  look_between_corners(corners, result);
  return result;
}

LatticeBody rectilinear_body(const geometry::Outline& outline, int reach) {
  constexpr double same = 1e-6;  // spacings; lattice units are rounded to 2^-20
  const auto cloud = geometry::lattice(outline, 1);
  std::vector<LatticeBody::Index> places;
  for (const Point& x : cloud.positions) places.push_back({int(std::floor(x.x())), int(std::floor(x.y())), 0});
  const auto edges = geometry::straight_edges(outline);
  return lattice_body(2, std::move(places), reach, [&](const LatticeBody::Index& inner, int axis, int towards) {
    const Point at = inner.head<2>().cast<double>() + 0.5;
    double nearest = Distance{}.value;
    for (const Edge& e : edges) {
      if (normal_axis(e) != axis || side(e) != towards) continue;
      const auto [low, high] = std::minmax(e.from[1 - axis], e.to[1 - axis]);
      const double away = towards * (e.from[axis] - at[axis]);
      if (low <= at[1 - axis] && at[1 - axis] <= high && away > 0) nearest = std::min(nearest, away);
    }
    if (nearest > 1 - same)
      throw Refused({{Subject::spacing, 0, "an edge passes through a row of points: change the spacing"}});
    return nearest;
  });
}

namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Distance along a ray from `at` to an edge.
double to_edge(const Point& at, const Point& along, const Edge& e) {
  const Point edge = e.to - e.from, from = e.from - at;
  const double sine = cross(along, edge);
  if (std::abs(sine) < 1e-9 * edge.norm()) return nothing;
  const double distance = cross(from, edge) / sine, share = cross(from, along) / sine;
  return share >= 0 && share <= 1 && distance > 0 ? distance : nothing;
}

/// The nearer of the two that is not where the ray begins.
double to_circle(const Point& at, const Point& along, const geometry::Circle& c) {
  const Point from = c.centre - at;
  const double middle = from.dot(along), square = c.radius * c.radius - from.squaredNorm() + middle * middle;
  if (square < 0) return nothing;
  for (const double distance : {middle - std::sqrt(square), middle + std::sqrt(square)})
    if (distance > 1e-6 * c.radius) return distance;
  return nothing;
}

bool lies_on(const Point& at, const Edge& e) {
  const Point edge = e.to - e.from;
  const double along = (at - e.from).dot(edge) / edge.squaredNorm();
  return along > 0 && along < 1 && std::abs(cross(edge, at - e.from)) < 1e-9 * edge.squaredNorm();
}

void look_at_corners(const std::vector<Edge>& edges, Clearance& c) {
  const double blunt = std::sqrt(0.75);  // cosine of 30 degrees
  for (const Edge& e : edges)
    for (const Edge& f : edges) {
      if (e.to != f.from) continue;
      const Point before = e.to - e.from, after = f.to - f.from;
      if (before.normalized().dot(after.normalized()) > blunt) continue;
      for (const Edge* one : {&e, &f}) look(c.step, (one->to - one->from).norm(), (one->from + one->to) / 2);
    }
}

}  // namespace

Clearance oblique_clearance(const geometry::Outline& outline, double spacing) {
  Clearance result;
  const auto edges = geometry::straight_edges(outline);
  look_at_corners(edges, result);
  geometry::Outline scaled = outline;
  const auto in_spacings = [&](Point& x) { x /= spacing; };
  for (auto& x : scaled.outer.vertices) in_spacings(x);
  for (auto& hole : scaled.holes)
    if (auto* polygon = std::get_if<geometry::Polygon>(&hole))
      for (auto& x : polygon->vertices) in_spacings(x);
    else
      std::get<geometry::Circle>(hole) = {std::get<geometry::Circle>(hole).centre / spacing,
                                          std::get<geometry::Circle>(hole).radius / spacing, ""};
  for (const auto& node : edge_nodes(scaled)) {
    const Point at = node.at * spacing;
    const Edge* own = nullptr;
    for (const Edge& e : edges)
      if (lies_on(at, e)) own = &e;
    const auto see = [&](double in, double out, bool next) {
      if (!next) look(result.width, in, at - in / 2 * node.normal);
      look(result.gap, out, at + out / 2 * node.normal);
    };
    for (const Edge& e : edges)
      if (&e != own)
        see(to_edge(at, -node.normal, e), to_edge(at, node.normal, e), own && (e.to == own->from || e.from == own->to));
    for (const auto& hole : outline.holes)
      if (const auto* circle = std::get_if<geometry::Circle>(&hole))
        see(to_circle(at, -node.normal, *circle), to_circle(at, node.normal, *circle), false);
  }
  return result;
}

Distance shortest_edge(const geometry::Outline& outline) {
  Distance result;
  for (const Edge& e : geometry::straight_edges(outline)) look(result, (e.to - e.from).norm(), (e.from + e.to) / 2);
  return result;
}

}  // namespace plate
