#include "geometry/shape/outline.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

/// Squared distance of the centre from the segment, less radius^2, times the squared length of the segment if its
/// foot lies inside: only the sign is of interest.
template <class Number>
Number disc_excess(const Circle& circle, const Point& p, const Point& q) {
  const Number px = Number(p.x()) - circle.centre.x(), py = Number(p.y()) - circle.centre.y();
  const Number qx = Number(q.x()) - circle.centre.x(), qy = Number(q.y()) - circle.centre.y();
  const Number dx = Number(q.x()) - p.x(), dy = Number(q.y()) - p.y();
  const Number square = Number(circle.radius) * circle.radius;
  if (px * dx + py * dy >= 0) return px * px + py * py - square;
  if (qx * dx + qy * dy <= 0) return qx * qx + qy * qy - square;
  const Number area = px * qy - py * qx;
  return area * area - square * (dx * dx + dy * dy);
}

/// True where the closed segment meets the open disc. Exact.
bool enters_disc(const Circle& circle, const Point& p, const Point& q) {
  const Point reach(circle.radius, circle.radius);
  if (!boxes_meet(p, q, circle.centre - reach, circle.centre + reach)) return false;
  const double size = std::max((p - circle.centre).norm() + (q - circle.centre).norm(), circle.radius);
  const double length = (q - p).norm();
  const double excess = disc_excess<double>(circle, p, q);
  const double safe = 1e-14 * size * size;  // some 50 roundings of terms of this size
  if (std::abs(excess) > safe * std::max({1.0, length * size, length * length})) return excess < 0;
  return disc_excess<Exact::FT>(circle, p, q) < 0;
}

/// True where the point lies in the closed disc. Exact.
bool touches_disc(const Circle& circle, const Point& x) {
  const double excess = disc_excess<double>(circle, x, x);
  const double safe = 1e-14 * ((x - circle.centre).squaredNorm() + circle.radius * circle.radius);
  return std::abs(excess) > safe ? excess < 0 : disc_excess<Exact::FT>(circle, x, x) <= 0;
}

/// True where a segment without proper crossings of the ring passes through the region at its `forbidden` side. Between
/// the vertices that lie on the segment, the midpoints decide. Exact.
bool passes(const Ring& ring, const Point& p, const Point& q, CGAL::Bounded_side forbidden) {
  const auto before = [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  Ring stops{p, q};
  std::vector<Exact::Point_2> exact;
  for (const Point& v : ring) {
    exact.emplace_back(v.x(), v.y());
    if (boxes_meet(p, q, v, v) && side(p, q, v) == 0) stops.push_back(v);
  }
  std::sort(stops.begin(), stops.end(), before);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const auto middle =
        CGAL::midpoint(Exact::Point_2(stops[i].x(), stops[i].y()), Exact::Point_2(stops[i + 1].x(), stops[i + 1].y()));
    if (CGAL::bounded_side_2(exact.begin(), exact.end(), middle, Exact()) == forbidden) return true;
  }
  return false;
}

bool crosses(const Ring& ring, const Point& p, const Point& q, CGAL::Bounded_side forbidden) {
  bool touches = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = next(ring, i);
    if (!boxes_meet(p, q, a, b)) continue;
    const int sides_of_edge = side(a, b, p) * side(a, b, q);
    const int sides_of_segment = side(p, q, a) * side(p, q, b);
    if (sides_of_edge < 0 && sides_of_segment < 0) return true;
    touches = touches || (sides_of_edge <= 0 && sides_of_segment <= 0);
  }
  return touches && passes(ring, p, q, forbidden);
}

/// The part of the ring with sign * coordinate <= half; edges along the cut may be run through twice.
Ring cut(const Ring& ring, int axis, double sign, double half) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = next(ring, i);
    const double over_a = sign * a[axis] - half, over_b = sign * b[axis] - half;
    if (over_a <= 0) kept.push_back(a);
    if ((over_a <= 0) == (over_b <= 0)) continue;
    Point x = a + (b - a) * (over_a / (over_a - over_b));
    x[axis] = sign * half;
    kept.push_back(x);
  }
  return kept;
}

/// Area that a ring and a square have in common: clipped by the square's four sides (Sutherland, Hodgman 1974).
/// Pieces that such clipping leaves connected are joined by lines without area.
double overlap(const Ring& ring, const Point& centre, double side_length) {
  const double half = side_length / 2;
  const Point corner(half, half);
  bool near = false;
  for (std::size_t i = 0; i < ring.size() && !near; ++i)
    near = boxes_meet(centre - corner, centre + corner, ring[i], next(ring, i));
  if (!near) return position(ring, centre) > 0 ? side_length * side_length : 0;
  Ring piece = ring;
  for (Point& v : piece) v -= centre;
  for (int axis : {0, 1})
    for (double sign : {-1.0, 1.0}) piece = cut(piece, axis, sign, half);
  return std::abs(signed_area(piece));
}

/// Signed area that the triangle (0, a, b) and the disc of this radius about 0 have in common.
double disc_wedge(const Point& a, const Point& b, double radius) {
  const auto sector = [&](const Point& u, const Point& v) {
    return radius * radius / 2 * std::atan2(cross(u, v), u.dot(v));
  };
  const Point d = b - a;
  const double root = std::pow(radius * d.norm(), 2) - std::pow(cross(a, b), 2);
  if (root <= 0) return sector(a, b);
  const double in = std::clamp((-a.dot(d) - std::sqrt(root)) / d.squaredNorm(), 0.0, 1.0);
  const double out = std::clamp((-a.dot(d) + std::sqrt(root)) / d.squaredNorm(), 0.0, 1.0);
  const Point u = a + in * d, v = a + out * d;
  return sector(a, u) + cross(u, v) / 2 + sector(v, b);
}

/// Area that a disc and a square have in common.
double overlap(const Circle& circle, const Point& centre, double side_length) {
  const double half = side_length / 2;
  const Point x = centre - circle.centre;
  const Eigen::Array2d away = x.array().abs();
  if ((away - half).max(0).matrix().norm() >= circle.radius) return 0;
  if ((away + half).matrix().norm() <= circle.radius) return side_length * side_length;
  const std::array<Point, 4> corners{x + Point(-half, -half), x + Point(half, -half), x + Point(half, half),
                                     x + Point(-half, half)};
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i) area += disc_wedge(corners[i], corners[(i + 1) % 4], circle.radius);
  return area;
}

double overlap(const Polygon& polygon, const Point& centre, double side_length) {
  return overlap(polygon.vertices, centre, side_length);
}

std::string name_of_edge(const Polygon& polygon, std::size_t i) {
  return i < polygon.edge_names.size() ? polygon.edge_names[i] : std::string();
}

}  // namespace

Outline rectangle(double xmin, double ymin, double xmax, double ymax) {
  return {{{{xmin, ymin}, {xmax, ymin}, {xmax, ymax}, {xmin, ymax}}, {"bottom", "right", "top", "left"}}, {}};
}

std::vector<Edge> straight_edges(const Outline& outline) {
  std::vector<Edge> edges;
  const auto append = [&](const Polygon& polygon, bool backwards) {
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      const Point &a = polygon.vertices[i], &b = next(polygon.vertices, i);
      edges.push_back({name_of_edge(polygon, i), backwards ? b : a, backwards ? a : b});
    }
  };
  append(outline.outer, false);
  for (const Hole& hole : outline.holes)
    if (const auto* polygon = std::get_if<Polygon>(&hole)) append(*polygon, signed_area(polygon->vertices) > 0);
  return edges;
}

std::vector<std::string> edge_names(const Outline& outline) {
  std::vector<std::string> names;
  const auto append = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const std::string& name : outline.outer.edge_names) append(name);
  for (const Hole& hole : outline.holes) {
    if (const auto* circle = std::get_if<Circle>(&hole)) append(circle->name);
    if (const auto* polygon = std::get_if<Polygon>(&hole))
      for (const std::string& name : polygon->edge_names) append(name);
  }
  return names;
}

double edge_length(const Outline& outline, const std::string& name) {
  double length = 0;
  for (const Edge& edge : straight_edges(outline))
    if (edge.name == name) length += (edge.to - edge.from).norm();
  for (const Circle& circle : circles(outline))
    if (circle.name == name) length += 2 * std::numbers::pi * circle.radius;
  return length;
}

bool contains(const Outline& outline, const Point& point) {
  if (position(outline.outer.vertices, point) <= 0) return false;
  return std::none_of(outline.holes.begin(), outline.holes.end(), [&](const Hole& hole) {
    if (const auto* polygon = std::get_if<Polygon>(&hole)) return position(polygon->vertices, point) >= 0;
    return touches_disc(std::get<Circle>(hole), point);
  });
}

double clipped_cell_area(const Outline& outline, const Point& centre, double side) {
  double rest = overlap(outline.outer, centre, side);
  for (const Hole& hole : outline.holes)
    rest -= std::visit([&](const auto& shape) { return overlap(shape, centre, side); }, hole);
  return std::max(rest, 0.0);
}

double area(const Outline& outline) {
  double rest = signed_area(outline.outer.vertices);
  for (const Hole& hole : outline.holes) {
    if (const auto* polygon = std::get_if<Polygon>(&hole)) rest -= std::abs(signed_area(polygon->vertices));
    if (const auto* circle = std::get_if<Circle>(&hole)) rest -= std::numbers::pi * circle->radius * circle->radius;
  }
  return rest;
}

bool leaves(const Outline& outline, const Point& p, const Point& q) {
  if (crosses(outline.outer.vertices, p, q, CGAL::ON_UNBOUNDED_SIDE)) return true;
  return std::any_of(outline.holes.begin(), outline.holes.end(), [&](const Hole& hole) {
    if (const auto* circle = std::get_if<Circle>(&hole)) return enters_disc(*circle, p, q);
    return crosses(std::get<Polygon>(hole).vertices, p, q, CGAL::ON_BOUNDED_SIDE);
  });
}

bool meet(const Point& p, const Point& q, const Point& a, const Point& b) {
  return boxes_meet(p, q, a, b) && side(a, b, p) * side(a, b, q) <= 0 && side(p, q, a) * side(p, q, b) <= 0;
}

std::pair<Point, Point> bounding_box(const std::vector<Point>& points) {
  Point low = points.at(0), high = low;
  for (const Point& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return {low, high};
}

std::pair<Point, Point> bounding_box(const Outline& outline) {
  return bounding_box(outline.outer.vertices);
}

double tolerance(const Outline& outline) {
  const auto [low, high] = bounding_box(outline);
  return 1e-9 * (high - low).norm();
}

namespace {

double distance_to(const Ring& ring, const Point& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) least = std::min(least, distance_to_segment(ring[i], next(ring, i), x));
  return least;
}

/// Messages about two edges of a ring that meet other than in the vertex that neighbours share.
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

std::vector<std::string> errors_alone(const Polygon& polygon) {
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

std::vector<std::string> errors_alone(const Circle& circle) {
  if (!circle.centre.allFinite()) return {text("centre ", at(circle.centre), " is not finite")};
  if (circle.radius > 0 && std::isfinite(circle.radius)) return {};
  return {text("radius ", circle.radius, " must be positive")};
}

std::vector<std::string> errors_inside(const Polygon& outer, const Circle& circle) {
  const auto self = text("circle of radius ", circle.radius, " about ", at(circle.centre));
  const double room = distance_to(outer.vertices, circle.centre);
  if (position(outer.vertices, circle.centre) <= 0)
    return {text(self, " has its centre ", room, " outside the outline")};
  if (room >= circle.radius) return {};
  return {text(self, " reaches ", circle.radius - room, " beyond the outline")};
}

std::vector<std::string> errors_inside(const Polygon& outer, const Polygon& hole) {
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

std::vector<Point> reentrant_corners(const std::vector<Point>& outer) {
  const double least = std::sin(20 * std::numbers::pi / 180);
  std::vector<Point> result;
  const auto at = [&](std::size_t i) -> const Point& { return outer[i % outer.size()]; };
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Point in = (at(i + 1) - at(i)).normalized(), out = (at(i + 2) - at(i + 1)).normalized();
    const double turn = cross(in, out);
    if (turn < -least || (turn < 0 && in.dot(out) < 0)) result.push_back(at(i + 1));
  }
  return result;
}

std::vector<Point> singular_corners(const Outline& outline) {
  auto result = reentrant_corners(outline.outer.vertices);
  for (const Hole& hole : outline.holes)
    if (const auto* polygon = std::get_if<Polygon>(&hole)) {
      Ring ring = polygon->vertices;
      if (signed_area(ring) > 0) std::reverse(ring.begin(), ring.end());  // so that the plate lies on its left
      const auto corners = reentrant_corners(ring);
      result.insert(result.end(), corners.begin(), corners.end());
    }
  return result;
}

std::vector<GeometryError> errors(const Outline& outline) {
  std::vector<GeometryError> found;
  const auto note = [&](const std::string& where, const std::vector<std::string>& all) {
    for (const std::string& what : all) found.push_back({where, what});
    return all.empty();
  };
  bool relations = note("outline", errors_alone(outline.outer));
  if (relations && signed_area(outline.outer.vertices) < 0)
    found.push_back({"outline", "is clockwise; list the vertices counter-clockwise"});
  const auto where = [](std::size_t i) { return text("holes[", i, "]"); };
  for (std::size_t i = 0; i < outline.holes.size(); ++i)
    if (!note(where(i), std::visit([](const auto& shape) { return errors_alone(shape); }, outline.holes[i])))
      relations = false;
  if (!relations) return found;
  for (std::size_t i = 0; i < outline.holes.size(); ++i) {
    note(where(i),
         std::visit([&](const auto& shape) { return errors_inside(outline.outer, shape); }, outline.holes[i]));
    for (std::size_t j = 0; j < i; ++j)
      if (collide(outline.holes[i], outline.holes[j])) found.push_back({where(i), text("overlaps ", where(j))});
  }
  return found;
}

}  // namespace geometry
