#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

double distance_to(const Ring& ring, const Point& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) least = std::min(least, distance_to_segment(ring[i], next(ring, i), x));
  return least;
}

/// Where two edges of a ring meet other than in the vertex that neighbours share.
std::vector<std::string> self_crossings(const Ring& ring) {
  std::vector<std::string> found;
  for (std::size_t j = 1; j < ring.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Point &a = ring[i], &b = next(ring, i), &c = ring[j], &d = next(ring, j);
      const bool shares_b = i + 1 == j, shares_a = i == 0 && j + 1 == ring.size();
      if (shares_b && side(a, b, d) == 0 && (a - b).dot(d - b) > 0)
        found.push_back(text("edges ", i, " and ", j, " fold back on each other at ", at(b)));
      else if (shares_a && side(b, a, c) == 0 && (b - a).dot(c - a) > 0)
        found.push_back(text("edges ", i, " and ", j, " fold back on each other at ", at(a)));
      else if (!shares_a && !shares_b && meet(a, b, c, d))
        found.push_back(text("edges ", i, " (from ", at(a), " to ", at(b), ") and ", j, " (from ", at(c), " to ", at(d),
                             ") cross"));
    }
  return found;
}

std::vector<std::string> faults_alone(const Polygon& polygon) {
  const Ring& ring = polygon.vertices;
  std::vector<std::string> found;
  if (ring.size() < 3) return {text("has ", ring.size(), " vertices; a polygon needs at least 3")};
  if (!polygon.edge_names.empty() && polygon.edge_names.size() != ring.size())
    found.push_back(text("has ", polygon.edge_names.size(), " edge names for ", ring.size(), " edges"));
  for (std::size_t j = 0; j < ring.size(); ++j) {
    if (!ring[j].allFinite()) return {text("vertex ", j, " at ", at(ring[j]), " is not finite")};
    for (std::size_t i = 0; i < j; ++i)
      if (ring[i] == ring[j]) found.push_back(text("vertices ", i, " and ", j, " are both at ", at(ring[i])));
  }
  if (!found.empty()) return found;
  if (std::all_of(ring.begin(), ring.end(), [&](const Point& v) { return side(ring[0], ring[1], v) == 0; }))
    return {"has no area: all vertices lie on one line"};
  return self_crossings(ring);
}

std::vector<std::string> faults_alone(const Circle& circle) {
  if (!circle.centre.allFinite()) return {text("centre ", at(circle.centre), " is not finite")};
  if (circle.radius > 0 && std::isfinite(circle.radius)) return {};
  return {text("radius ", circle.radius, " must be positive")};
}

std::vector<std::string> faults_inside(const Polygon& outer, const Circle& circle) {
  const auto self = text("circle of radius ", circle.radius, " about ", at(circle.centre));
  const double room = distance_to(outer.vertices, circle.centre);
  if (position(outer.vertices, circle.centre) <= 0)
    return {text(self, " has its centre ", room, " outside the outline")};
  if (room >= circle.radius) return {};
  return {text(self, " reaches ", circle.radius - room, " beyond the outline")};
}

std::vector<std::string> faults_inside(const Polygon& outer, const Polygon& hole) {
  std::vector<std::string> found;
  const Ring &ring = hole.vertices, &bound = outer.vertices;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (position(bound, ring[i]) < 0)
      found.push_back(
          text("vertex ", i, " at ", at(ring[i]), " lies ", distance_to(bound, ring[i]), " outside the outline"));
  if (!found.empty()) return found;
  for (std::size_t i = 0; i < ring.size(); ++i)
    for (std::size_t j = 0; j < bound.size(); ++j)
      if (meet(ring[i], next(ring, i), bound[j], next(bound, j)))
        found.push_back(text("edge ", i, " crosses or touches edge ", j, " of the outline"));
  return found;
}

bool collide(const Polygon& a, const Polygon& b) {
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    for (std::size_t j = 0; j < b.vertices.size(); ++j)
      if (meet(a.vertices[i], next(a.vertices, i), b.vertices[j], next(b.vertices, j))) return true;
  return position(a.vertices, b.vertices[0]) >= 0 || position(b.vertices, a.vertices[0]) >= 0;
}

bool collide(const Polygon& a, const Circle& b) {
  return distance_to(a.vertices, b.centre) < b.radius || position(a.vertices, b.centre) >= 0;
}

bool collide(const Circle& a, const Polygon& b) {
  return collide(b, a);
}

bool collide(const Circle& a, const Circle& b) {
  return (a.centre - b.centre).norm() < a.radius + b.radius;
}

bool collide(const Hole& a, const Hole& b) {
  return std::visit([](const auto& s, const auto& t) { return collide(s, t); }, a, b);
}

}  // namespace

std::vector<Fault> faults(const Outline& outline) {
  std::vector<Fault> found;
  const auto note = [&](const std::string& where, const std::vector<std::string>& all) {
    for (const std::string& what : all) found.push_back({where, what});
    return all.empty();
  };
  bool relations = note("outline", faults_alone(outline.outer));
  if (relations && signed_area(outline.outer.vertices) < 0)
    found.push_back({"outline", "is clockwise; list the vertices counter-clockwise"});
  const auto where = [](std::size_t i) { return text("holes[", i, "]"); };
  for (std::size_t i = 0; i < outline.holes.size(); ++i)
    if (!note(where(i), std::visit([](const auto& shape) { return faults_alone(shape); }, outline.holes[i])))
      relations = false;
  if (!relations) return found;
  for (std::size_t i = 0; i < outline.holes.size(); ++i) {
    note(where(i),
         std::visit([&](const auto& shape) { return faults_inside(outline.outer, shape); }, outline.holes[i]));
    for (std::size_t j = 0; j < i; ++j)
      if (collide(outline.holes[i], outline.holes[j])) found.push_back({where(i), text("overlaps ", where(j))});
  }
  return found;
}

}  // namespace geometry
