#include "geometry/cells/uncracked_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/cells/triangulation.hpp"
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

/// A ring of points about the end of a crack through a node behind it.
struct RingThrough {
  double radius;
  Point back;  // unit vector from the end to the node
};

/// The nodes that follow the end of a curve, as far as its pieces bend by at most fifteen degrees.
std::vector<Point> nodes_of_curve(const Curves& curves, const Point& tip, const Point& first) {
  constexpr double straight = 0.9659;  // cosine
  std::vector<Point> result{tip, first};
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    const Point at = result.back(), along = (at - result[result.size() - 2]).normalized();
    for (const auto& piece : curves.pieces)
      for (const auto& [k, other] : {std::pair(piece.from, piece.to), std::pair(piece.to, piece.from)}) {
        if (goes_on || piece.edge != Curves::crack || curves.nodes[k] != at) continue;
        const Point step = curves.nodes[other] - at;
        if (step.dot(along) <= straight * step.norm()) continue;
        result.push_back(curves.nodes[other]), goes_on = true;
      }
    if (result.size() > curves.nodes.size()) break;
  }
  return {result.begin() + 1, result.end()};
}

/// Rings through the nodes of a crack behind its end, by their distance, where the distance of points grows: nodes
/// straight behind it, or else of a curve.
std::vector<RingThrough> rings_behind(const Curves& curves, const Sizing& sizing, const Point& tip, const Point& back,
                                      const Point& first) {
  std::vector<RingThrough> all, result;
  for (const auto& piece : curves.pieces)
    for (const auto k : {piece.from, piece.to}) {
      const Point x = curves.nodes[k] - tip;
      if (piece.edge == Curves::crack && back.dot(x) > 0 && std::abs(cross(back, x)) < 1e-6 * x.norm())
        all.push_back({back.dot(x), back});
    }
  const auto bent = all.size() > 2 ? std::vector<Point>() : nodes_of_curve(curves, tip, first);  // one counts twice
  if (bent.size() > 1) {
    all.clear();
    for (const auto& node : bent) all.push_back({(node - tip).norm(), (node - tip).normalized()});
  }
  std::ranges::sort(all, {}, &RingThrough::radius);
  double size = sizing(tip), last = 0;
  for (const auto& [r, direction] : all) {
    const double here = sizing(tip + r * direction);
    if (here < size || here >= 1) break;
    if (r - last < 0.5 * size) continue;  // a node counts twice
    result.push_back({r, direction}), last = r, size = here;
  }
  return result;
}

/// Node before the end of the crack at `tip`, nothing where no crack ends there.
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

/// Adds points in rings about the ends of cracks, as far apart as wanted, until they are as far apart as anywhere else:
/// so the triangles about a tip are nearly equal, and the same on both sides of the crack.
void add_rings(TriangleMesh& mesh, const Curves& curves, const Sizing& sizing, const std::vector<Point>& tips) {
  for (const auto& tip : tips) {
    const auto from = neighbour(curves, tip);
    if (!from || sizing(tip) >= 1) continue;
    const Point back = (*from - tip).normalized();
    const auto start = mesh.locate(tip, 0, false).triangle;
    if (start == TriangleMesh::none) continue;
    std::array<std::int32_t, 2> at{start, start};  // triangles that were changed last, on either side
    double r = 0;
    for (const auto& [next, direction] : rings_behind(curves, sizing, tip, back, *from))
      add_ring(mesh, sizing, tip, direction, r = next, at);
    for (double size = sizing(tip - r * back); size < 1;) {
      r += 0.95 * sizing(tip - (r + size / 2) * back);
      const double here = sizing(tip - r * back);
      if (here < size) break;
      size = here;
      add_ring(mesh, sizing, tip, -back, r, at);
    }
  }
}

/// Adds rings of points about a place in the plate. `away`: a unit vector along which other centres do not disturb the
/// rings.
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

/// Adds points in rows of equilateral triangles wherever one spacing is wanted.
void add_rows(TriangleMesh& mesh, const Sizing& sizing) {
  const auto [low, high] = bounding_box(mesh.points());
  const double height = std::sqrt(0.75);
  std::int32_t at = 0;
  bool shifted = false;
  for (double y = low.y() + height; y < high.y(); y += height, shifted = !shifted)
    for (double x = low.x() + (shifted ? 0.5 : 0); x < high.x(); ++x)
      if (sizing({x, y}) >= 1) add(mesh, {x, y}, 1, at);
}

/// Adds points where triangles are larger than wanted or have angles below 20.7 degrees, as far as the angles between
/// curves allow that and features are not smaller than 1/64 of what is wanted.
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

  /// True for a triangle whose angle at corner `opposite` lies between two curves.
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

constexpr int rounds = 5;

/// Marks the points of a mesh that are nodes of its curves: single places among them are on no side of a triangle that
/// is marked.
std::vector<char> nodes_of(const Curves& curves, const TriangleMesh& mesh) {
  const auto before = [](const Point& a, const Point& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); };
  auto nodes = curves.nodes;
  std::ranges::sort(nodes, before);
  std::vector<char> result;
  for (const auto& x : mesh.points()) result.push_back(std::ranges::binary_search(nodes, x, before));
  return result;
}

/// Points that may move, with the triangles about each. `fixed`: points that may not, beside those on curves.
class Stars {
public:
  Stars(const TriangleMesh& mesh, const std::vector<char>& fixed)
      : free_(mesh.points().size(), 1), opposite_(mesh.points().size(), [&](const auto& visit) {
          for (const auto& [corner, across, mark, inside] : mesh.triangles())
            for (std::size_t i = 0; inside && i < 3; ++i)
              visit(corner[i], std::pair(corner[(i + 1) % 3], corner[(i + 2) % 3]));
        }) {
    for (std::size_t k = 0; k < fixed.size(); ++k) free_[k] = !fixed[k];
    for (const auto& [corner, across, mark, inside] : mesh.triangles())
      for (std::size_t i = 0; inside && i < 3; ++i)
        if (mark[i] != TriangleMesh::unmarked) free_[corner[(i + 1) % 3]] = free_[corner[(i + 2) % 3]] = 0;
  }

  bool is_free(std::uint32_t k) const { return free_[k] && !opposite_[k].empty(); }
  /// The sides opposite to k.
  auto about(std::uint32_t k) const { return opposite_[k]; }

private:
  std::vector<char> free_;
  Grouped<std::pair<std::uint32_t, std::uint32_t>> opposite_;
};

/// Area over the sum of the squared sides: 0 where flat, negative where turned over.
double quality(const Point& a, const Point& b, const Point& c) {
  return cross(b - a, c - a) / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
}

/// Moves points that are on no curve, and none of its nodes, to the middle of the triangles about them.
void smooth(TriangleMesh& mesh, const Curves& curves, const Sizing& sizing) {
  const auto fixed = nodes_of(curves, mesh);
  std::vector<double> size;
  for (const auto& x : mesh.points()) size.push_back(sizing(x));
  for (int round = 0; round < rounds; ++round) {
    const Stars stars(mesh, fixed);
    for (std::uint32_t k = 0; k < mesh.points().size(); ++k) {
      if (!stars.is_free(k)) continue;
      const auto& points = mesh.points();
      const Point x = points[k];
      Point sum(0, 0);
      double weights = 0, worst = 1;
      for (const auto& [a, b] : stars.about(k)) {
        // centroids by mass, where the density of points goes with 1 / size^2 (Lloyd: by 1 / size^4)
        const double mean = (size[k] + size[a] + size[b]) / 3, square = mean * mean;
        const double weight = cross(points[a] - x, points[b] - x) / (square * square);
        sum += weight * ((points[a] - x) + (points[b] - x)) / 3, weights += weight;
        worst = std::min(worst, quality(x, points[a], points[b]));
      }
      const Point to = x + 1.2 * sum / weights;
      double least = 1;
      for (const auto& [a, b] : stars.about(k))
        least = std::min(least, side(to, points[a], points[b]) > 0 ? quality(to, points[a], points[b]) : -1);
      if (least < std::min(worst, 0.15) || least <= 0) continue;
      mesh.move(k, to);
      size[k] = sizing(to);
    }
    mesh.exchange_sides();
  }
}

TriangleMesh filled(const Curves& curves, const Sizing& sizing, const RingCentres& centres) {
  TriangleMesh mesh(curves);
  add_rings(mesh, curves, sizing, centres.tips);
  for (const auto& [place, away] : centres.forces) add_rings(mesh, sizing, place, away);
  add_rows(mesh, sizing);
  Refinement(mesh, sizing).run();
  smooth(mesh, curves, sizing);
  return mesh;
}

/// Orders points by strips one spacing high, so that neighbours are near in memory.
std::vector<std::uint32_t> in_strips(const std::vector<Point>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Point &x = points[a], &y = points[b];
    const double strip = std::floor(x.y()), other = std::floor(y.y());
    return strip != other ? strip < other : x.x() != y.x() ? x.x() < y.x() : x.y() < y.y();
  });
  return order;
}

}  // namespace

Cells graded_cells(const Curves& curves, const Sizing& sizing, const RingCentres& centres) {
  const auto mesh = filled(curves, sizing, centres);
  const auto order = in_strips(mesh.points());
  std::vector<std::uint32_t> index(order.size());
  Cells result;
  for (std::uint32_t i = 0; i < order.size(); ++i)
    index[order[i]] = i, result.positions.push_back(mesh.points()[order[i]]);
  for (const auto& triangle : mesh.triangles()) {
    if (!triangle.inside) continue;
    const auto& [a, b, c] = triangle.corner;
    result.triangles.push_back({index[a], index[b], index[c]});
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = triangle.corner[(i + 1) % 3], to = triangle.corner[(i + 2) % 3];
      // a piece of a crack has two triangles
      if (triangle.mark[i] >= 0 || (triangle.mark[i] == Curves::crack && from < to))
        result.pieces.push_back({index[from], index[to], triangle.mark[i]});
    }
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

}  // namespace geometry
