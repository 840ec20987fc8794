#include "geometry/lattice/curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

/// Places that nodes must be at: none closer to another than what counts as one place.
class Places {
public:
  Places(const Outline& outline, const Sizing& sizing, bool on_lattice) : sizing_(sizing), on_lattice_(on_lattice) {
    const auto [low, high] = bounding_box(outline);
    least_ = 1e-9 * (high - low).norm();  // what crack_paths() takes for the noise of decimals
  }

  /// Distance below which two places count as one.
  double same(const Point& x) const { return std::max(least_, 1e-5 * sizing_(x)); }

  /// The place that is known next to x, or else x, known from now on.
  Point known(const Point& x) {
    const double near = same(x);
    const auto column = [](double u) { return std::int64_t(std::floor(u)); };
    for (auto i = column(x.x() - near); i <= column(x.x() + near); ++i)
      for (auto j = column(x.y() - near); j <= column(x.y() + near); ++j)
        if (const auto found = in_square_.find({i, j}); found != in_square_.end())
          for (const auto& other : found->second)
            if ((other - x).norm() <= near) return other;
    const Point place = on_lattice_ ? onto_lattice(x) : x;
    in_square_[{column(place.x()), column(place.y())}].push_back(place);
    return place;
  }

private:
  const Sizing& sizing_;
  bool on_lattice_;
  double least_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Point>> in_square_;
};

struct Segment {
  Point from, to;
  std::int32_t edge;
  bool alone = false;             // a crack with tips only: it needs a point with two faces
  std::vector<Point> stops = {};  // between the ends
};

/// Positions 0 ... 1 along a curve of this length, without the ends, so that neighbours are as far apart as wanted: at
/// most 1.2 times as far.
std::vector<double> subdivision(double length, const std::function<Point(double)>& at, const Sizing& sizing) {
  std::vector<double> place{0}, sum{0};  // of length / size, in steps of a quarter of the size
  while (place.back() < 1) {
    const double step = std::min(1.0 / 16, sizing(at(place.back())) / (4 * length));
    const double end = std::min(1.0, place.back() + step), middle = (place.back() + end) / 2;
    sum.push_back(sum.back() + (end - place.back()) * length / sizing(at(middle)));
    place.push_back(end);
  }
  const int count = std::max(1, int(std::ceil(sum.back() - 0.2)));
  std::vector<double> result;
  std::size_t i = 0;
  for (int n = 1; n < count; ++n) {
    const double wanted = sum.back() * n / count;
    while (sum[i + 1] < wanted) ++i;
    result.push_back(place[i] + (wanted - sum[i]) / (sum[i + 1] - sum[i]) * (place[i + 1] - place[i]));
  }
  return result;
}

/// Axis of the line of lattice points on which the segment lies; -1 where it lies on none.
int lattice_axis(const Point& a, const Point& b) {
  for (const int axis : {0, 1})
    if (a[1 - axis] == b[1 - axis] && a[1 - axis] == std::round(a[1 - axis])) return axis;
  return -1;
}

/// Lattice points between two points of a lattice line, half a spacing or more from either.
std::vector<Point> lattice_points(const Point& a, const Point& b, int axis) {
  std::vector<Point> result;
  const double low = std::min(a[axis], b[axis]), high = std::max(a[axis], b[axis]);
  for (double x = std::ceil(low + 0.5); x <= high - 0.5; ++x) {
    Point point = a;
    point[axis] = x;
    result.push_back(point);
  }
  if (a[axis] > b[axis]) std::reverse(result.begin(), result.end());
  return result;
}

class Builder {
public:
  Builder(const Sizing& sizing, bool on_lattice) : sizing_(sizing), on_lattice_(on_lattice) {}

  std::int32_t name(const std::string& edge) {
    auto& names = result.names;
    const auto found = std::find(names.begin(), names.end(), edge);
    if (found == names.end()) names.push_back(edge);
    return std::int32_t(std::find(names.begin(), names.end(), edge) - names.begin());
  }

  std::uint32_t node(const Point& x) {
    const auto [entry, fresh] = index_.try_emplace({x.x(), x.y()}, std::uint32_t(result.nodes.size()));
    if (fresh) result.nodes.push_back(x);
    return entry->second;
  }

  /// Nodes on a circle, at the given places on it among others. Clockwise: the plate is on the left.
  void circle(const Circle& circle, std::vector<Point> on_it) {
    const auto angle = [&](const Point& x) { return std::atan2(circle.centre.y() - x.y(), x.x() - circle.centre.x()); };
    std::sort(on_it.begin(), on_it.end(), [&](const Point& a, const Point& b) { return angle(a) < angle(b); });
    on_it.erase(std::unique(on_it.begin(), on_it.end()), on_it.end());
    if (on_it.empty()) on_it.push_back(place(circle, 0));
    Ring ring;
    for (std::size_t i = 0; i < on_it.size(); ++i) {
      const double from = angle(on_it[i]), to = i + 1 < on_it.size() ? angle(on_it[i + 1]) : angle(on_it[0]) + 2 * pi;
      ring.push_back(on_it[i]);
      const auto at = [&](double t) { return place(circle, from + t * (to - from)); };
      const Sizing finer = [&](const Point& x) { return std::min(sizing_(x), circle.radius * pi / 4); };
      for (const double t : subdivision((to - from) * circle.radius, at, finer)) ring.push_back(at(t));
    }
    std::vector<Point> closed = ring;
    closed.push_back(ring.front());
    chain(closed, name(circle.name));
    result.outline.holes.push_back(Polygon{ring, std::vector<std::string>(ring.size(), circle.name)});
  }

  void segment(const Segment& segment) {
    std::vector<Point> stops = segment.stops;
    stops.push_back(segment.from), stops.push_back(segment.to);
    const Point along = segment.to - segment.from;
    std::sort(stops.begin(), stops.end(), [&](const Point& a, const Point& b) { return along.dot(a) < along.dot(b); });
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    std::vector<Point> points{stops.front()};
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Point a = stops[i], b = stops[i + 1];
      const int axis = on_lattice_ ? lattice_axis(a, b) : -1;
      if (axis >= 0) {
        for (const auto& x : lattice_points(a, b, axis)) points.push_back(x);
      } else {
        const auto at = [&](double t) -> Point { return a + t * (b - a); };
        for (const double t : subdivision((b - a).norm(), at, sizing_))
          points.push_back(on_lattice_ ? onto_lattice(at(t)) : at(t));
      }
      points.push_back(b);
    }
    if (segment.alone && points.size() == 2) points.insert(points.begin() + 1, (segment.from + segment.to) / 2);
    chain(points, segment.edge);
  }

  Curves result;

private:
  Point place(const Circle& circle, double clockwise) const {
    const Point x = circle.centre + circle.radius * Point(std::cos(clockwise), -std::sin(clockwise));
    return on_lattice_ ? onto_lattice(x) : x;
  }

  static constexpr double pi = std::numbers::pi;

  void chain(const std::vector<Point>& points, std::int32_t edge) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      if (points[i] != points[i + 1]) result.pieces.push_back({node(points[i]), node(points[i + 1]), edge});
  }

  const Sizing& sizing_;
  bool on_lattice_;
  std::map<std::pair<double, double>, std::uint32_t> index_;
};

/// Adds stops where an end of one segment lies on the other, or where the two cross.
void meet(Segment& one, Segment& other, Places& places) {
  bool touch = false;
  const auto join = [&](const Point& x, Segment& segment) {
    if (x == segment.from || x == segment.to) {
      touch = true;
    } else if (distance_to_segment(segment.from, segment.to, x) < places.same(x)) {
      segment.stops.push_back(x);
      touch = true;
    }
  };
  const Point margin = Point::Constant(1e-3).cwiseMax(places.same(one.from));
  if (!boxes_meet(one.from.cwiseMin(one.to) - margin, one.from.cwiseMax(one.to) + margin, other.from, other.to)) return;
  for (const auto& x : {one.from, one.to}) join(x, other);
  for (const auto& x : {other.from, other.to}) join(x, one);
  if (touch || side(one.from, one.to, other.from) * side(one.from, one.to, other.to) >= 0 ||
      side(other.from, other.to, one.from) * side(other.from, other.to, one.to) >= 0)
    return;
  const Point d = one.to - one.from, e = other.to - other.from;
  const Point x = places.known(one.from + cross(other.from - one.from, e) / cross(d, e) * d);
  one.stops.push_back(x), other.stops.push_back(x);
}

/// The point of a straight edge or circle next to x, if there is one.
Point put_onto(const Outline& outline, const std::vector<Edge>& edges, const Point& x, double near) {
  for (const auto& edge : edges)
    if (distance_to_segment(edge.from, edge.to, x) < near) return nearest_on_segment(edge.from, edge.to, x);
  for (const Circle& circle : circles(outline)) {
    const Point from = x - circle.centre;
    if (std::abs(from.norm() - circle.radius) < near) return circle.centre + circle.radius * from.normalized();
  }
  return x;
}

}  // namespace

Point onto_lattice(const Point& u, double noise) {
  const auto coordinate = [noise](double x) { return std::abs(x - std::round(x)) < noise ? std::round(x) : x; };
  return {coordinate(u.x()), coordinate(u.y())};
}

Curves curves(const Outline& outline, std::vector<CrackPath> cracks, const std::vector<Point>& singles,
              const Sizing& sizing, bool on_lattice) {
  Builder builder(sizing, on_lattice);
  Places places(outline, sizing, on_lattice);
  const auto straight = straight_edges(outline);
  const auto joined = [&](const Point& x) { return places.known(put_onto(outline, straight, x, places.same(x))); };
  std::vector<Segment> segments;
  for (const auto& edge : straight)
    segments.push_back({places.known(edge.from), places.known(edge.to), builder.name(edge.name)});
  const std::size_t edges = segments.size();
  std::vector<Point> vertices, points;
  for (auto& crack : cracks)
    for (auto& x : crack.vertices) x = joined(x), vertices.push_back(x);
  for (const auto& x : singles) points.push_back(joined(x)), vertices.push_back(points.back());
  builder.result.outline.outer = outline.outer;
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole)) {
      std::vector<Point> on_it;
      for (const auto& x : vertices)
        if (std::abs((x - circle->centre).norm() - circle->radius) < places.same(x)) on_it.push_back(x);
      builder.circle(*circle, on_it);
    } else {
      builder.result.outline.holes.push_back(hole);
    }
  for (const auto& crack : cracks)
    for (std::size_t i = 0; i + 1 < crack.vertices.size(); ++i)
      if (crack.vertices[i] != crack.vertices[i + 1])
        segments.push_back({crack.vertices[i], crack.vertices[i + 1], Curves::crack,
                            crack.vertices.size() == 2 && crack.front == End::tip && crack.back == End::tip});
  for (std::size_t i = edges; i < segments.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) meet(segments[i], segments[j], places);
  for (const auto& x : points)
    for (auto& segment : segments)
      if (x != segment.from && x != segment.to && distance_to_segment(segment.from, segment.to, x) < places.same(x))
        segment.stops.push_back(x);
  for (const auto& segment : segments) builder.segment(segment);
  for (const auto& x : points) builder.node(x);
  return std::move(builder.result);
}

}  // namespace geometry
