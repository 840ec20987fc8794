#include "geometry/curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/predicates.hpp"

namespace geometry {
namespace {

constexpr double same = 1e-5;  // spacings; what is closer is one place

Point rounded(const Point& x) {
  return LatticeUnits{}.to_lattice(x);
}

struct Segment {
  Point from, to;
  std::int32_t edge;
  std::vector<Point> stops = {};  // between the ends
};

/// Positions 0 ... 1 along a curve of this length, without the ends, so that neighbours are as far apart as wanted: at
/// most 1.2 times as far.
std::vector<double> subdivision(double length, const std::function<Point(double)>& at, const Sizing& sizing) {
  const int samples = std::max(16, int(4 * length));
  std::vector<double> sum{0};  // of length / size
  for (int i = 0; i < samples; ++i) sum.push_back(sum.back() + length / samples / sizing(at((i + 0.5) / samples)));
  const int count = std::max(1, int(std::ceil(sum.back() - 0.2)));
  std::vector<double> result;
  for (int n = 1, i = 0; n < count; ++n) {
    const double wanted = sum.back() * n / count;
    while (sum[std::size_t(i) + 1] < wanted) ++i;
    const double low = sum[std::size_t(i)], high = sum[std::size_t(i) + 1];
    result.push_back((i + (wanted - low) / (high - low)) / samples);
  }
  return result;
}

/// Does the segment lie on a line of lattice points?
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

  void chain(const std::vector<Point>& points, std::int32_t edge) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      if (points[i] != points[i + 1]) result.pieces.push_back({node(points[i]), node(points[i + 1]), edge});
  }

  /// Nodes on a circle, at the ends of cracks among others. Clockwise: the plate is on the left.
  void circle(const Circle& circle, std::vector<CrackPath>& cracks, std::vector<Point>& singles) {
    std::vector<double> angles;
    const auto join = [&](Point& x) {
      const Point from = x - circle.centre;
      if (std::abs(from.norm() - circle.radius) > same) return;
      angles.push_back(std::atan2(-from.y(), from.x()));
      x = place(circle, angles.back());
    };
    for (auto& crack : cracks)
      for (auto& x : crack.vertices) join(x);
    for (auto& x : singles) join(x);
    if (angles.empty()) angles.push_back(0);
    std::sort(angles.begin(), angles.end());
    angles.push_back(angles.front() + 2 * std::numbers::pi);
    Ring ring;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      const double from = angles[i], turn = angles[i + 1] - from;
      ring.push_back(place(circle, from));
      const auto at = [&](double t) { return place(circle, from + t * turn); };
      const Sizing finer = [&](const Point& x) { return std::min(sizing_(x), circle.radius * std::numbers::pi / 4); };
      for (const double t : subdivision(turn * circle.radius, at, finer)) ring.push_back(at(t));
    }
    const auto edge = name(circle.name);
    std::vector<Point> closed = ring;
    closed.push_back(ring.front());
    chain(closed, edge);
    result.outline.holes.push_back(Polygon{ring, std::vector<std::string>(ring.size(), circle.name)});
  }

  void segment(const Segment& segment) {
    std::vector<Point> stops = segment.stops;
    stops.push_back(segment.from), stops.push_back(segment.to);
    const Point along = segment.to - segment.from;
    std::sort(stops.begin(), stops.end(), [&](const Point& a, const Point& b) { return along.dot(a) < along.dot(b); });
    std::vector<Point> points{stops.front()};
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Point a = stops[i], b = stops[i + 1];
      if ((b - a).norm() < same) continue;
      const int axis = on_lattice_ ? lattice_axis(a, b) : -1;
      if (axis >= 0) {
        for (const auto& x : lattice_points(a, b, axis)) points.push_back(x);
      } else {
        const auto at = [&](double t) -> Point { return a + t * (b - a); };
        for (const double t : subdivision((b - a).norm(), at, sizing_)) points.push_back(rounded(at(t)));
      }
      points.push_back(b);
    }
    chain(points, segment.edge);
  }

  Curves result;

private:
  static Point place(const Circle& circle, double clockwise) {
    return rounded(circle.centre + circle.radius * Point(std::cos(clockwise), -std::sin(clockwise)));
  }

  const Sizing& sizing_;
  bool on_lattice_;
  std::map<std::pair<double, double>, std::uint32_t> index_;
};

/// Where the ends of one meet the other, or both cross.
void meet(Segment& one, Segment& other) {
  bool touch = false;
  const auto join = [&](const Point& x, Segment& segment) {
    if ((x - segment.from).norm() < same || (x - segment.to).norm() < same) {
      touch = true;
    } else if (distance_to_segment(segment.from, segment.to, x) < same) {
      segment.stops.push_back(x);
      touch = true;
    }
  };
  for (const auto& x : {one.from, one.to}) join(x, other);
  for (const auto& x : {other.from, other.to}) join(x, one);
  if (touch || side(one.from, one.to, other.from) * side(one.from, one.to, other.to) >= 0 ||
      side(other.from, other.to, one.from) * side(other.from, other.to, one.to) >= 0)
    return;
  const Point d = one.to - one.from, e = other.to - other.from;
  const Point x = rounded(one.from + cross(other.from - one.from, e) / cross(d, e) * d);
  one.stops.push_back(x), other.stops.push_back(x);
}

/// Vertices of cracks next to a corner or to a vertex of another crack are put onto it.
void join_vertices(const Outline& outline, std::vector<CrackPath>& cracks) {
  std::vector<Point> known;
  for (const auto& edge : straight_edges(outline)) known.push_back(edge.from);
  for (auto& crack : cracks)
    for (auto& x : crack.vertices) {
      const auto near =
          std::find_if(known.begin(), known.end(), [&](const Point& other) { return (other - x).norm() < same; });
      if (near != known.end()) x = *near;
      known.push_back(x);
    }
}

}  // namespace

Curves curves(const Outline& outline, std::vector<CrackPath> cracks, const std::vector<Point>& singles,
              const Sizing& sizing, bool on_lattice) {
  Builder builder(sizing, on_lattice);
  join_vertices(outline, cracks);
  std::vector<Point> points = singles;
  builder.result.outline.outer = outline.outer;
  for (const auto& hole : outline.holes)
    if (const auto* circle = std::get_if<Circle>(&hole))
      builder.circle(*circle, cracks, points);
    else
      builder.result.outline.holes.push_back(hole);
  std::vector<Segment> segments;
  for (const auto& edge : straight_edges(outline)) segments.push_back({edge.from, edge.to, builder.name(edge.name)});
  for (const auto& crack : cracks)
    for (std::size_t i = 0; i + 1 < crack.vertices.size(); ++i)
      segments.push_back({crack.vertices[i], crack.vertices[i + 1], Curves::crack});
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (segments[i].edge == Curves::crack || segments[j].edge == Curves::crack) meet(segments[i], segments[j]);
  for (const auto& x : points)
    for (auto& segment : segments)
      if (distance_to_segment(segment.from, segment.to, x) < same) segment.stops.push_back(x);
  for (const auto& segment : segments) builder.segment(segment);
  for (const auto& x : points) builder.node(x);
  return std::move(builder.result);
}

}  // namespace geometry
