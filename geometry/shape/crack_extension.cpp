#include "geometry/shape/crack_extension.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/predicates.hpp"

namespace geometry {
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

/// ... to the circle, from outside.
std::optional<double> hit(const Point& x, const Point& direction, const Circle& circle) {
  const double ahead = (circle.centre - x).dot(direction), aside = cross(direction, circle.centre - x);
  const double half = circle.radius * circle.radius - aside * aside;
  if (half < 0 || ahead <= 0) return std::nullopt;
  return ahead - std::sqrt(half);
}

Point nearest_on(const Point& a, const Point& b, const Point& x) {
  const double share = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return a + share * (b - a);
}

/// ... on what of the segment lies ahead of the tip; what is beside it counts.
std::optional<Point> nearest_ahead(Point a, Point b, const Tip& tip) {
  const double from = (a - tip.position).dot(tip.direction), to = (b - tip.position).dot(tip.direction);
  const double rounding = 1e-9 * (std::abs(from) + std::abs(to) + (b - a).norm());
  if (std::max(from, to) < -rounding) return std::nullopt;
  if (std::min(from, to) < -rounding) (from < to ? a : b) = a + from / (from - to) * (b - a);
  return a == b ? a : nearest_on(a, b, tip.position);
}

/// Calls visit(a, b) for the segments of all cracks but the one that ends at the tip.
template <typename Visit>
void for_each_segment(const std::vector<Polyline>& cracks, const Tip& tip, const Visit& visit) {
  for (std::size_t c = 0; c < cracks.size(); ++c)
    for (std::size_t i = 1; i < cracks[c].size(); ++i)
      if (c != tip.crack || i != (tip.at_back ? cracks[c].size() - 1 : 1)) visit(c, cracks[c][i - 1], cracks[c][i]);
}

}  // namespace

std::optional<Obstacle> obstacle_ahead(const Outline& outline, const std::vector<Polyline>& cracks, const Tip& tip,
                                       const Point& direction, double reach) {
  std::optional<Obstacle> first;
  const auto take = [&](std::optional<double> found, const std::string& name, std::optional<std::size_t> crack) {
    if (found && *found <= reach && (!first || *found < first->distance))
      first = {*found, tip.position + *found * direction, name, crack};
  };
  for (const auto& edge : straight_edges(outline))
    take(hit(tip.position, direction, edge.from, edge.to), edge.name, {});
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole)) take(hit(tip.position, direction, *circle), circle->name, {});
  for_each_segment(cracks, tip, [&](std::size_t c, const Point& a, const Point& b) {
    take(hit(tip.position, direction, a, b), "", c);
  });
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
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole)) {
      const Point at = circle->centre + circle->radius * (tip.position - circle->centre).normalized();
      take(nearest_ahead(at, at, tip), circle->name, {});
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
