#include "plate/surface/oblique/clearance.hpp"

#include <cmath>
#include "plate/surface/oblique/edge_nodes.hpp"

namespace plate {

namespace {

using geometry::Edge;
using geometry::Point;
constexpr double nothing = std::numeric_limits<double>::infinity();

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How far along a ray from `at` an edge lies.
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

void look(Distance& least, double value, const Point& at) {
  if (value < least.value) least = {value, at};
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
