#include "geometry/cells/graded_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

/// Makes x a point unless one is closer than 0.7 of what is wanted, or a curve closer than half of it. `at`: a triangle
/// near x; afterwards one nearer to it.
bool add(TriangleMesh& mesh, const Point& x, double wanted, std::int32_t& at) {
  const auto found = mesh.locate(x, at, false);
  if (found.triangle == TriangleMesh::none) return false;
  at = found.triangle;
  if (!mesh.triangles()[std::size_t(at)].inside || !mesh.carve(at, x)) return false;
  for (const auto& rim : mesh.rim()) {
    const Point &a = mesh.points()[rim.from], &b = mesh.points()[rim.to];
    if ((a - x).norm() < 0.7 * wanted) return false;
    if (rim.mark != TriangleMesh::unmarked && distance_to_segment(a, b, x) < 0.5 * wanted) return false;
  }
  mesh.insert(x);
  at = mesh.changed().front();
  return true;
}

/// The nodes of a crack straight behind its end, by their distance; where the distance of points grows.
std::vector<double> radii(const Curves& curves, const Sizing& sizing, const Point& tip, const Point& back) {
  std::vector<double> all, result;
  for (const auto& piece : curves.pieces)
    for (const auto k : {piece.from, piece.to}) {
      const Point x = curves.nodes[k] - tip;
      if (piece.edge == Curves::crack && back.dot(x) > 0 && std::abs(cross(back, x)) < 1e-6 * x.norm())
        all.push_back(back.dot(x));
    }
  std::sort(all.begin(), all.end());
  double size = sizing(tip), last = 0;
  for (const double r : all) {
    const double here = sizing(tip + r * back);
    if (here < size || here >= 1) break;
    if (r - last < 0.5 * size) continue;  // a node counts twice
    result.push_back(last = r), size = here;
  }
  return result;
}

/// Where the crack that ends at a node comes from.
std::optional<Point> neighbour(const Curves& curves, const Point& tip) {
  for (const auto& piece : curves.pieces)
    for (const auto& [k, other] : {std::pair(piece.from, piece.to), std::pair(piece.to, piece.from)})
      if (piece.edge == Curves::crack && (curves.nodes[k] - tip).norm() < 1e-3 * (curves.nodes[other] - tip).norm())
        return curves.nodes[other];
  return std::nullopt;
}

/// `first`: 0, or 1 where there is a point in the direction `back` already.
void add_ring(TriangleMesh& mesh, const Sizing& sizing, const Point& tip, const Point& back, double r,
              std::array<std::int32_t, 2>& at, long first = 1) {
  const double wanted = sizing(tip + r * back);
  const auto count = std::max(6L, std::lround(2 * std::numbers::pi * r / (0.93 * wanted)));
  for (long n = first; n < count; ++n) {
    // both sides in turn, so that they look the same
    const double angle = 2 * std::numbers::pi / double(count) * double(n % 2 == 1 ? (n + 1) / 2 : -(n / 2));
    const Point x = tip + r * (std::cos(angle) * back + std::sin(angle) * Point(-back.y(), back.x()));
    if (std::abs(sizing(x) - wanted) < 0.02 * wanted) add(mesh, x, wanted, at[n % 2]);
  }
}

}  // namespace

void add_rings(TriangleMesh& mesh, const Curves& curves, const Sizing& sizing, const std::vector<Point>& tips) {
  for (const auto& tip : tips) {
    const auto from = neighbour(curves, tip);
    if (!from || sizing(tip) >= 1) continue;
    const Point back = (*from - tip).normalized();
    const auto start = mesh.locate(tip, 0, false).triangle;
    if (start == TriangleMesh::none) continue;
    std::array<std::int32_t, 2> at{start, start};  // triangles that were changed last, on either side
    double r = 0;
    for (const double next : radii(curves, sizing, tip, back)) add_ring(mesh, sizing, tip, back, r = next, at);
    for (double size = sizing(tip - r * back); size < 1;) {
      r += 0.95 * sizing(tip - (r + size / 2) * back);
      const double here = sizing(tip - r * back);
      if (here < size) break;
      size = here;
      add_ring(mesh, sizing, tip, -back, r, at);
    }
  }
}

void add_rings(TriangleMesh& mesh, const Sizing& sizing, const Point& place, const Point& away) {
  const auto start = mesh.locate(place, 0, false).triangle;
  if (start == TriangleMesh::none) return;
  std::array<std::int32_t, 2> at{start, start};
  double r = 0;
  for (double size = sizing(place); size < 1;) {
    r += 0.95 * sizing(place + (r + size / 2) * away);
    const double here = sizing(place + r * away);
    if (here < size) break;
    size = here;
    add_ring(mesh, sizing, place, away, r, at, 0);
  }
}

void add_rows(TriangleMesh& mesh, const Sizing& sizing) {
  Point low = mesh.points().front(), high = low;
  for (const auto& x : mesh.points()) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double height = std::sqrt(0.75);
  std::int32_t at = 0;
  bool shifted = false;
  for (double y = low.y() + height; y < high.y(); y += height, shifted = !shifted)
    for (double x = low.x() + (shifted ? 0.5 : 0); x < high.x(); ++x)
      if (sizing({x, y}) >= 1) add(mesh, {x, y}, 1, at);
}

namespace {

class Refinement {
public:
  Refinement(TriangleMesh& mesh, const Sizing& sizing) : mesh_(mesh), sizing_(sizing) {}

  void run() {
    for (std::size_t t = 0; t < mesh_.triangles().size(); ++t) open_.push_back(std::int32_t(t));
    while (!open_.empty()) {
      const auto t = open_.back();
      open_.pop_back();
      if (mesh_.triangles()[std::size_t(t)].inside && improved(t))
        open_.insert(open_.end(), mesh_.changed().begin(), mesh_.changed().end());
    }
  }

private:
  static constexpr double too_large =
      0.78;  // radius of the circle over the side that is wanted; 0.58 where all are equal
  static constexpr double too_flat = 1.414;  // radius of the circle over the shortest side: 20.7 degrees
  static constexpr double unresolved = 64;   // features so many times smaller than what is wanted are left as they are

  /// Its smallest angle lies between two curves.
  static bool is_corner(const TriangleMesh::Triangle& triangle, std::size_t opposite) {
    return triangle.mark[(opposite + 1) % 3] != TriangleMesh::unmarked &&
           triangle.mark[(opposite + 2) % 3] != TriangleMesh::unmarked;
  }

  bool improved(std::int32_t t) {
    const auto triangle = mesh_.triangles()[std::size_t(t)];
    const Point &a = mesh_.points()[triangle.corner[0]], b = mesh_.points()[triangle.corner[1]] - a,
                c = mesh_.points()[triangle.corner[2]] - a;
    const std::array<double, 3> sides{(c - b).norm(), c.norm(), b.norm()};
    const auto shortest = std::size_t(std::min_element(sides.begin(), sides.end()) - sides.begin());
    const double twice = cross(b, c), radius = sides[0] * sides[1] * sides[2] / (2 * twice);
    const double wanted = sizing_(a + (b + c) / 3);
    const bool large = radius > too_large * wanted;
    const bool flat =
        radius > too_flat * sides[shortest] && !is_corner(triangle, shortest) && sides[shortest] * unresolved > wanted;
    if (!large && !flat) return false;
    const Point middle = a + Point(c.y() * b.squaredNorm() - b.y() * c.squaredNorm(),
                                   b.x() * c.squaredNorm() - c.x() * b.squaredNorm()) /
                                 (2 * twice);
    return middle.allFinite() && add_at(middle, t, wanted, large && !flat ? 0 : sides[shortest]);
  }

  /// `feature`: the side that asks for shorter ones, 0 where triangles are large only.
  bool add_at(const Point& x, std::int32_t t, double wanted, double feature) {
    const auto found = mesh_.locate(x, t, true);
    if (found.triangle == TriangleMesh::none) return false;
    if (found.blocked) return halved(found.triangle, *found.blocked, wanted, feature);
    if (!mesh_.carve(found.triangle, x)) return false;
    for (const auto& rim : mesh_.rim()) {
      const Point &p = mesh_.points()[rim.from], &q = mesh_.points()[rim.to];
      if (rim.mark == TriangleMesh::unmarked) continue;
      if (feature > 0 && (p - x).dot(q - x) < 0 && (q - p).norm() > 1.2 * feature) {
        const auto side = side_of(rim);
        return side && halved(side->first, side->second, wanted, feature);
      }
      if (distance_to_segment(p, q, x) < std::min(0.4 * wanted, feature > 0 ? feature / 2 : wanted)) return false;
    }
    mesh_.insert(x);
    return true;
  }

  /// The triangle and its side that a rim is, before anything is changed.
  std::optional<std::pair<std::int32_t, std::size_t>> side_of(const TriangleMesh::Rim& rim) const {
    for (const auto t : mesh_.changed())
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& corner = mesh_.triangles()[std::size_t(t)].corner;
        if (corner[(i + 1) % 3] == rim.from && corner[(i + 2) % 3] == rim.to) return std::pair(t, i);
      }
    return std::nullopt;
  }

  bool halved(std::int32_t t, std::size_t i, double wanted, double feature) {
    const auto& corner = mesh_.triangles()[std::size_t(t)].corner;
    const double length = (mesh_.points()[corner[(i + 1) % 3]] - mesh_.points()[corner[(i + 2) % 3]]).norm();
    if (length < (feature > 0 ? 1.2 * feature : 1.3 * wanted)) return false;
    return mesh_.halve(t, i);
  }

  TriangleMesh& mesh_;
  const Sizing& sizing_;
  std::vector<std::int32_t> open_;
};

}  // namespace

void refine(TriangleMesh& mesh, const Sizing& sizing) {
  Refinement(mesh, sizing).run();
}

}  // namespace geometry
