#include "geometry/shape/snapping.hpp"

#include <algorithm>
#include <limits>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

/// The nearest point of a segment.
Point foot(const Point& a, const Point& b, const Point& x) {
  const Point d = b - a;
  const double square = d.squaredNorm();
  return square > 0 ? Point(a + std::clamp(d.dot(x - a) / square, 0.0, 1.0) * d) : a;
}

/// The nearest place of those that it was shown.
struct Nearest {
  Point x, place{0, 0};
  double distance = std::numeric_limits<double>::infinity();
  std::string name{};

  /// True: it is nearer than all before.
  bool look(const Point& there) {
    const double length = (there - x).norm();
    if (length >= distance) return false;
    place = there, distance = length;
    return true;
  }
};

Nearest nearest(const Outline& outline, const std::vector<Polyline>& cracks, std::size_t own, const Point& x) {
  Nearest result{x};
  for (const Edge& edge : straight_edges(outline))
    if (result.look(foot(edge.from, edge.to, x))) result.name = edge.name;
  for (const Hole& hole : outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole); circle && x != circle->centre)
      if (result.look(circle->centre + circle->radius * (x - circle->centre).normalized())) result.name = circle->name;
  std::size_t nearest = cracks.size();
  for (std::size_t other = 0; other < cracks.size(); ++other)
    for (std::size_t i = 0; other != own && i + 1 < cracks[other].size(); ++i)
      if (result.look(foot(cracks[other][i], cracks[other][i + 1], x))) nearest = other;
  if (nearest < cracks.size()) result.name = text("cracks[", nearest, "]");
  return result;
}

}  // namespace

Snapped snapped(const Outline& outline, std::vector<Polyline> cracks, double reach) {
  constexpr double share = 1e-3;  // of the segment: far above rounding to five digits, far below what is drawn
  const double touching = tolerance(outline);
  Snapped result;
  for (std::size_t crack = 0; crack < cracks.size(); ++crack) {
    auto& v = cracks[crack];
    if (v.size() < 2) continue;
    for (const bool at_back : {false, true}) {
      Point& x = at_back ? v.back() : v.front();
      const Point& before = at_back ? v[v.size() - 2] : v[1];
      const auto found = nearest(outline, cracks, crack, x);
      if (found.distance <= touching || !(found.distance <= std::min(reach, share * (x - before).norm()))) continue;
      x = found.place;
      result.snaps.push_back({crack, at_back, found.distance, found.name});
    }
  }
  result.cracks = std::move(cracks);
  return result;
}

}  // namespace geometry
