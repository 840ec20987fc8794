#include "geometry/shape/crack_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

constexpr double closure = 1.0 / 1024;  // how far a mouth or a junction is extended straight ahead

/// The side of a vector to which the infinitesimal (e, e^2) points: +1 left, -1 right.
int side_of_shift(const Point& d) {
  return d.y() != 0 ? (d.y() < 0 ? 1 : -1) : (d.x() < 0 ? -1 : 1);
}

/// The side of the line from a to b on which a shifted point lies; never 0.
int shifted_side(const Point& a, const Point& b, const Point& point) {
  const int s = side(a, b, point);
  return s != 0 ? s : side_of_shift(b - a);
}

/// The side of a shifted bond on which a vertex lies; 0 for a tip that touches the bond.
int side_of_bond(const Point& p, const Point& q, const Point& vertex, bool tip) {
  const int s = side(p, q, vertex);
  return s != 0 || tip ? s : -side_of_shift(q - p);
}

bool near(const Point& p, const Point& q, const Point& a, const Point& b) {
  const Point margin(closure, closure);
  return boxes_meet(p.cwiseMin(q) - margin, p.cwiseMax(q) + margin, a, b);
}

Point ahead(const Point& from, const Point& end) {
  return (end - from).normalized();
}

/// True where the bond crosses segment i. The line is that of the unextended segment, so that points on it stay on it.
bool crosses(const CrackPath& crack, std::size_t i, const Point& p, const Point& q) {
  const Point &a = crack.vertices[i], &b = crack.vertices[i + 1];
  if (shifted_side(a, b, p) == shifted_side(a, b, q)) return false;
  const bool front = i == 0, back = i + 2 == crack.vertices.size();
  const bool front_tip = front && crack.front == End::tip, back_tip = back && crack.back == End::tip;
  const Point from = front && !front_tip ? Point(a + closure * ahead(b, a)) : a;
  const Point to = back && !back_tip ? Point(b + closure * ahead(a, b)) : b;
  return side_of_bond(p, q, from, front_tip) * side_of_bond(p, q, to, back_tip) < 0;
}

/// True where the end of a crack is within tolerance of another crack, or of a part of its own beyond its first
/// segment.
bool joins(const std::vector<Polyline>& polylines, std::size_t crack, bool at_back, double tolerance) {
  const Polyline& own = polylines[crack];
  const Point& end = at_back ? own.back() : own.front();
  const Polyline rest(at_back ? own.begin() : own.begin() + 1, at_back ? own.end() - 1 : own.end());
  if (rest.size() > 1 && distance(rest, end) <= tolerance) return true;
  for (std::size_t other = 0; other < polylines.size(); ++other)
    if (other != crack && distance(polylines[other], end) <= tolerance) return true;
  return false;
}

bool outside(const Outline& outline, const Point& x, double tolerance) {
  return !contains(outline, x) && distance_to_boundary(outline, x) > tolerance;
}

/// The hole in which the point lies; none for a point beyond the outer boundary.
std::optional<std::size_t> hole_at(const Outline& outline, const Point& x) {
  for (std::size_t i = 0; i < outline.holes.size(); ++i) {
    const auto* circle = std::get_if<Circle>(&outline.holes[i]);
    const auto* polygon = std::get_if<Polygon>(&outline.holes[i]);
    if (circle ? (x - circle->centre).norm() < circle->radius : contains({*polygon, {}}, x)) return i;
  }
  return std::nullopt;
}

/// Positions along ab, from 0 to 1, that split it where it meets the boundary.
std::vector<double> splits(const Outline& outline, const Point& a, const Point& b) {
  const Point d = b - a;
  std::vector<double> all{0, 1};
  for (const Edge& edge : straight_edges(outline)) {
    const double sine = cross(d, edge.to - edge.from);
    if (sine != 0 && meet(a, b, edge.from, edge.to)) all.push_back(cross(edge.from - a, edge.to - edge.from) / sine);
  }
  for (const Circle& circle : circles(outline)) {
    const Point from = a - circle.centre;
    const double root = std::pow(circle.radius * d.norm(), 2) - std::pow(cross(from, d), 2);
    if (root <= 0) continue;
    for (double sign : {-1.0, 1.0}) all.push_back((-from.dot(d) + sign * std::sqrt(root)) / d.squaredNorm());
  }
  for (double& t : all) t = std::clamp(t, 0.0, 1.0);
  std::sort(all.begin(), all.end());
  return all;
}

/// Describes where a segment between two ends in the plate leaves it; nothing where it does not.
std::optional<std::string> excursion(const Outline& outline, const Point& a, const Point& b, double tolerance) {
  if (outside(outline, a, tolerance) || outside(outline, b, tolerance)) return std::nullopt;
  const std::vector<double> t = splits(outline, a, b);
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    const Point from = a + t[k] * (b - a), to = a + t[k + 1] * (b - a), middle = (from + to) / 2;
    if (!outside(outline, middle, tolerance)) continue;
    const auto hole = hole_at(outline, middle);
    return text("runs ", hole ? text("through holes[", *hole, "]") : "outside the outline", " between ", at(from),
                " and ", at(to), "; split it into two cracks");
  }
  return std::nullopt;
}

/// True where two segments share more than a point of the same line.
bool runs_along(const Point& a, const Point& b, const Point& c, const Point& d, double tolerance) {
  const double slack = tolerance * (d - c).norm();
  if (std::abs(cross(d - c, a - c)) > slack || std::abs(cross(d - c, b - c)) > slack) return false;
  const Point along = ahead(c, d);
  const double start = std::min(along.dot(a - c), along.dot(b - c)), end = std::max(along.dot(a - c), along.dot(b - c));
  return std::min(end, (d - c).norm()) - std::max(start, 0.0) > tolerance;
}

std::vector<std::string> errors_alone(const Polyline& crack, double tolerance) {
  if (crack.size() < 2) return {text("has ", crack.size(), " vertices; a crack needs at least 2")};
  std::vector<std::string> found;
  for (std::size_t i = 0; i < crack.size(); ++i) {
    if (!crack[i].allFinite()) return {text("vertex ", i, " at ", at(crack[i]), " is not finite")};
    if (i > 0 && (crack[i] - crack[i - 1]).norm() <= tolerance)
      found.push_back(text("segment ", i - 1, " from ", at(crack[i - 1]), " to ", at(crack[i]), " has no length"));
  }
  if (!found.empty()) return found;
  for (std::size_t j = 1; j + 1 < crack.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Point &a = crack[i], &b = crack[i + 1], &c = crack[j], &d = crack[j + 1];
      const bool joined = (i == 0 && distance_to_segment(c, d, a) <= tolerance) ||
                          (j + 2 == crack.size() && distance_to_segment(a, b, d) <= tolerance);
      if (runs_along(a, b, c, d, tolerance))
        found.push_back(text("segments ", i, " and ", j, " run along each other"));
      else if (i + 1 < j && !joined && meet(a, b, c, d))
        found.push_back(text("segments ", i, " and ", j, " cross; split it into two cracks"));
    }
  return found;
}

std::vector<std::string> errors_in_plate(const Outline& outline, const Polyline& crack, double tolerance) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < crack.size(); ++i) {
    if (!outside(outline, crack[i], tolerance)) continue;
    const auto hole = hole_at(outline, crack[i]);
    found.push_back(text("vertex ", i, " at ", at(crack[i]), " lies ", distance_to_boundary(outline, crack[i]),
                         hole ? text(" inside holes[", *hole, "]") : " outside the outline"));
  }
  for (std::size_t i = 0; i + 1 < crack.size(); ++i) {
    if (const auto what = excursion(outline, crack[i], crack[i + 1], tolerance))
      found.push_back(text("segment ", i, " ", *what));
    for (const Edge& edge : straight_edges(outline))
      if (runs_along(crack[i], crack[i + 1], edge.from, edge.to, tolerance))
        found.push_back(
            text("segment ", i, " from ", at(crack[i]), " to ", at(crack[i + 1]), " lies on the edge ", edge.name));
  }
  return found;
}

}  // namespace

double distance_to_boundary(const Outline& outline, const Point& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Edge& edge : straight_edges(outline)) least = std::min(least, distance_to_segment(edge.from, edge.to, x));
  for (const Circle& circle : circles(outline))
    least = std::min(least, std::abs((x - circle.centre).norm() - circle.radius));
  return least;
}

std::vector<CrackPath> crack_paths(const Outline& outline, const std::vector<Polyline>& polylines, double tolerance) {
  std::vector<CrackPath> paths;
  for (std::size_t crack = 0; crack < polylines.size(); ++crack) {
    const auto end = [&](bool at_back) {
      const Point& x = at_back ? polylines[crack].back() : polylines[crack].front();
      if (distance_to_boundary(outline, x) <= tolerance) return End::mouth;
      return joins(polylines, crack, at_back, tolerance) ? End::junction : End::tip;
    };
    paths.push_back({polylines[crack], end(false), end(true)});
  }
  return paths;
}

std::vector<Tip> tips(const std::vector<CrackPath>& paths) {
  std::vector<Tip> all;
  for (std::size_t crack = 0; crack < paths.size(); ++crack) {
    const Polyline& v = paths[crack].vertices;
    if (paths[crack].front == End::tip) all.push_back({v.front(), ahead(v[1], v[0]), crack, false});
    if (paths[crack].back == End::tip) all.push_back({v.back(), ahead(v[v.size() - 2], v.back()), crack, true});
  }
  return all;
}

bool separates(const CrackPath& crack, const Point& p, const Point& q) {
  for (std::size_t i = 0; i + 1 < crack.vertices.size(); ++i)
    if (near(p, q, crack.vertices[i], crack.vertices[i + 1]) && crosses(crack, i, p, q)) return true;
  return false;
}

std::vector<GeometryError> errors(const Outline& outline, const std::vector<Polyline>& polylines, double tolerance) {
  std::vector<GeometryError> found;
  const auto where = [](std::size_t i) { return text("cracks[", i, "]"); };
  constexpr std::size_t most_crossings = 10000;  // cells between more of them take minutes
  std::size_t crossings = 0;
  const auto along = [&](const Polyline& one, const Polyline& other) {
    for (std::size_t i = 0; i + 1 < one.size(); ++i)
      for (std::size_t j = 0; j + 1 < other.size(); ++j) {
        const Point &a = one[i], &b = one[i + 1], &c = other[j], &d = other[j + 1];
        if (runs_along(a, b, c, d, tolerance)) return true;
        if (crossings <= most_crossings && meet(a, b, c, d)) ++crossings;
      }
    return false;
  };
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t i = 0; i < polylines.size(); ++i) {
    auto all = errors_alone(polylines[i], tolerance);
    if (all.empty()) all = errors_in_plate(outline, polylines[i], tolerance);
    for (const std::string& what : all) found.push_back({where(i), what});
    auto& box = boxes.emplace_back();
    for (const Point& x : polylines[i]) box.extend(x);
    if (!box.isEmpty()) box = {box.min().array() - tolerance, box.max().array() + tolerance};
    for (std::size_t j = 0; j < i; ++j)
      if (box.intersects(boxes[j]) && along(polylines[i], polylines[j]))
        found.push_back({where(i), text("runs along ", where(j))});
  }
  if (crossings > most_crossings)
    found.push_back({"cracks", text("cross each other at more than ", most_crossings, " places; give fewer cracks")});
  return found;
}

double distance(const Polyline& polyline, const Point& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& v : polyline) least = std::min(least, (v - point).norm());
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
    least = std::min(least, distance_to_segment(polyline[i], polyline[i + 1], point));
  return least;
}

namespace {

/// Distance along the ray from x to the segment ab; of one that lies on the ray, to its nearer end.
std::optional<double> hit(const Point& x, const Point& direction, const Point& a, const Point& b) {
  const double turn = cross(direction, b - a), on_ray = 1e-9 * ((a - x).norm() + (b - x).norm());
  if (std::abs(cross(direction, a - x)) <= on_ray && std::abs(cross(direction, b - x)) <= on_ray) {
    const double nearer = std::min(direction.dot(a - x), direction.dot(b - x));
    return nearer > 0 ? std::optional(nearer) : std::nullopt;
  }
  const double along = cross(a - x, b - a) / turn, share = cross(a - x, direction) / turn;
  if (along <= 0 || share < 0 || share > 1) return std::nullopt;
  return along;
}

/// Distance along the ray from x to the circle, from outside.
std::optional<double> hit(const Point& x, const Point& direction, const Circle& circle) {
  const double ahead = (circle.centre - x).dot(direction), aside = cross(direction, circle.centre - x);
  const double half = circle.radius * circle.radius - aside * aside;
  if (half < 0 || ahead <= 0) return std::nullopt;
  return ahead - std::sqrt(half);
}

/// Nearest point to the tip on the part of the segment that lies ahead of it; what is beside it counts.
std::optional<Point> nearest_ahead(Point a, Point b, const Tip& tip) {
  const double from = (a - tip.position).dot(tip.direction), to = (b - tip.position).dot(tip.direction);
  const double rounding = 1e-9 * (std::abs(from) + std::abs(to) + (b - a).norm());
  if (std::max(from, to) < -rounding) return std::nullopt;
  if (std::min(from, to) < -rounding) (from < to ? a : b) = a + from / (from - to) * (b - a);
  return nearest_on_segment(a, b, tip.position);
}

/// Calls visit(a, b) for the segments of all cracks but the one that ends at the tip.
template <typename Visit>
void for_each_segment(const std::vector<Polyline>& cracks, const Tip& tip, const Visit& visit) {
  for (std::size_t c = 0; c < cracks.size(); ++c)
    for (std::size_t i = 1; i < cracks[c].size(); ++i)
      if (c != tip.crack || i != (tip.at_back ? cracks[c].size() - 1 : 1)) visit(c, cracks[c][i - 1], cracks[c][i]);
}

}  // namespace

namespace {

/// The place where the ray from a tip first comes nearer than `beside` to one of the cracks that it misses: at its
/// beginning what lies ahead or beside, then a vertex. None between two that are equally far, as mirror images are.
std::optional<Obstacle> passed(const std::vector<Polyline>& cracks, const std::vector<char>& missed, const Tip& tip,
                               double reach, double beside) {
  const double equal = 1e-9 * (reach + beside);  // what rounding leaves between mirror images
  std::optional<Obstacle> first;
  bool two = false;
  const auto take = [&](const Point& x, std::size_t crack) {
    const double away = (x - tip.position).norm();
    if (away > (first ? first->distance + equal : reach)) return;
    const bool nearer = !first || away < first->distance - equal;
    two = !nearer && (two || (x - first->position).norm() > equal);
    if (nearer) first = {away, x, "", crack};
  };
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    if (!missed[c]) continue;
    for (const Point& v : cracks[c])
      if (tip.direction.dot(v - tip.position) > 0 && std::abs(cross(tip.direction, v - tip.position)) < beside)
        take(v, c);
    for (std::size_t i = 1; i < cracks[c].size(); ++i)
      if (const auto x = nearest_ahead(cracks[c][i - 1], cracks[c][i], tip); x && (*x - tip.position).norm() < beside)
        take(*x, c);
  }
  return two ? std::nullopt : first;
}

}  // namespace

std::optional<Obstacle> obstacle_ahead(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                       const Point& direction, double reach, double beside) {
  std::optional<Obstacle> first;
  const auto take = [&](std::optional<double> found, const std::string& name, std::optional<std::size_t> crack) {
    if (found && *found <= reach && (!first || *found < first->distance))
      first = {*found, tip.position + *found * direction, name, crack};
  };
  for (const auto& edge : straight_edges(outline))
    take(hit(tip.position, direction, edge.from, edge.to), edge.name, {});
  for (const Circle& circle : circles(outline)) take(hit(tip.position, direction, circle), circle.name, {});
  std::vector<char> missed(cracks.size(), beside > 0);
  if (tip.crack < cracks.size()) missed[tip.crack] = 0;
  for_each_segment(cracks, tip, [&](std::size_t c, const Point& a, const Point& b) {
    const auto found = hit(tip.position, direction, a, b);
    if (found && *found <= reach) missed[c] = 0;
    take(found, "", c);
  });
  if (const auto near = passed(cracks, missed, {tip.position, direction, tip.crack, tip.at_back}, reach, beside))
    if (!first || near->distance < first->distance) first = near;
  return first;
}

std::optional<Obstacle> nearest_obstacle(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                         double reach) {
  std::optional<Obstacle> nearest;
  const auto take = [&](const std::optional<Point>& at, const std::string& name, std::optional<std::size_t> crack) {
    if (!at) return;
    const double distance = (*at - tip.position).norm();
    if (distance <= (nearest ? nearest->distance : reach)) nearest = {distance, *at, name, crack};
  };
  for (const auto& edge : straight_edges(outline)) take(nearest_ahead(edge.from, edge.to, tip), edge.name, {});
  for (const Circle& circle : circles(outline)) {
    const Point at = circle.centre + circle.radius * (tip.position - circle.centre).normalized();
    take(nearest_ahead(at, at, tip), circle.name, {});
  }
  for_each_segment(cracks, tip, [&](std::size_t c, const Point& a, const Point& b) {
    if (c != tip.crack) take(nearest_ahead(a, b, tip), "", c);
  });
  return nearest;
}

void extend(Polyline& crack, bool at_back, const Point& to) {
  Point& end = at_back ? crack.back() : crack.front();
  const Point before = at_back ? crack[crack.size() - 2] : crack[1];
  const Point last = end - before, step = to - end;
  if (std::abs(cross(last, step)) <= 1e-9 * last.norm() * step.norm() && last.dot(step) > 0)
    end = to;
  else
    crack.insert(at_back ? crack.end() : crack.begin(), to);
}

double length(const Polyline& polyline) {
  double sum = 0;
  for (std::size_t i = 1; i < polyline.size(); ++i) sum += (polyline[i] - polyline[i - 1]).norm();
  return sum;
}

}  // namespace geometry
