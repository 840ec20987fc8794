#include "geometry/cells/triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <stdexcept>
#include <unordered_map>

#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Face = CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel,
                                                       CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

}  // namespace

std::variant<Triangulated, std::string> delaunay(const std::vector<Point>& points,
                                                 const std::vector<std::array<std::uint32_t, 2>>& pieces) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> places;
  for (const auto& x : points) places.emplace_back(Kernel::Point_2(x.x(), x.y()), std::uint32_t(places.size()));
  Triangulation triangulation;
  triangulation.insert(places.begin(), places.end());
  if (triangulation.number_of_vertices() != points.size()) return "two points at one place";
  std::vector<Triangulation::Vertex_handle> vertex(points.size());
  for (const auto v : triangulation.finite_vertex_handles()) vertex[v->info()] = v;
  try {
    for (const auto& [from, to] : pieces) triangulation.insert_constraint(vertex[from], vertex[to]);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return "edges and cracks cross each other within a spacing";
  }
  Triangulated result;
  for (const auto face : triangulation.all_face_handles()) face->info() = Triangulated::none;
  std::int32_t count = 0;
  for (const auto face : triangulation.finite_face_handles()) face->info() = count++;
  for (const auto face : triangulation.finite_face_handles()) {
    auto& corners = result.corners.emplace_back();
    auto& across = result.across.emplace_back();
    for (int i = 0; i < 3; ++i)
      corners[std::size_t(i)] = face->vertex(i)->info(), across[std::size_t(i)] = face->neighbor(i)->info();
  }
  return result;
}

Triangulated required_triangles(const std::vector<Point>& points,
                                const std::vector<std::array<std::uint32_t, 2>>& pieces) {
  auto found = delaunay(points, pieces);
  if (const auto* reason = std::get_if<std::string>(&found)) throw std::invalid_argument(*reason);
  return std::get<Triangulated>(std::move(found));
}

std::vector<Fence> fences(const std::vector<Curves::Piece>& pieces) {
  std::vector<Fence> result;
  for (const auto& piece : pieces)
    if (piece.edge != Curves::crack) result.push_back({piece.from, piece.to, true, false});
  return result;
}

std::vector<char> within(const Triangulated& triangles, const std::vector<Fence>& fences) {
  const auto directed = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t(a) << 32 | b; };
  std::unordered_map<std::uint64_t, char> left_of;
  left_of.reserve(4 * fences.size());
  for (const auto& fence : fences) {
    left_of[directed(fence.from, fence.to)] = fence.left;
    left_of[directed(fence.to, fence.from)] = fence.right;
  }
  constexpr char unknown = 2;
  std::vector<char> result(triangles.corners.size(), unknown);
  std::vector<std::array<bool, 3>> open(result.size());
  std::vector<std::size_t> reached;
  const auto tell = [&](std::size_t t, char what) {
    if (result[t] == unknown) result[t] = what, reached.push_back(t);
    if (result[t] != what) throw std::logic_error("edges do not part the plate from what is beside it");
  };
  for (std::size_t t = 0; t < result.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& corner = triangles.corners[t];
      const auto found = left_of.find(directed(corner[(i + 1) % 3], corner[(i + 2) % 3]));
      open[t][i] = found == left_of.end();
      if (!open[t][i])
        tell(t, found->second);
      else if (triangles.across[t][i] == Triangulated::none)
        tell(t, false);
    }
  while (!reached.empty()) {
    const auto t = reached.back();
    reached.pop_back();
    for (std::size_t i = 0; i < 3; ++i)
      if (open[t][i] && triangles.across[t][i] != Triangulated::none)
        tell(std::size_t(triangles.across[t][i]), result[t]);
  }
  for (const char what : result)
    if (what == unknown) throw std::logic_error("no edge parts the plate from what is beside it");
  return result;
}

TriangleMesh::TriangleMesh(const Curves& curves) : points_(curves.nodes) {
  std::vector<std::array<std::uint32_t, 2>> pieces;
  std::unordered_map<std::uint64_t, std::int32_t> mark_of;
  const auto key = [](std::uint32_t a, std::uint32_t b) {
    return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
  };
  for (const auto& [from, to, edge] : curves.pieces) pieces.push_back({from, to}), mark_of[key(from, to)] = edge;
  const auto found = required_triangles(points_, pieces);
  const auto inside = within(found, fences(curves.pieces));
  for (std::size_t t = 0; t < inside.size(); ++t) {
    const auto& corner = found.corners[t];
    Triangle triangle{corner, found.across[t], {}, bool(inside[t])};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto mark = mark_of.find(key(corner[after(i)], corner[before(i)]));
      triangle.mark[i] = mark == mark_of.end() ? unmarked : mark->second;
    }
    triangles_.push_back(triangle);
  }
  stamp_.assign(triangles_.size(), 0);
}

bool TriangleMesh::in_circle(std::int32_t triangle, const Point& x) const {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto at = [](const Point& p) { return Kernel::Point_2(p.x(), p.y()); };
  const auto& [a, b, c] = triangles_[std::size_t(triangle)].corner;
  return CGAL::side_of_oriented_circle(at(points_[a]), at(points_[b]), at(points_[c]), at(x)) == CGAL::ON_POSITIVE_SIDE;
}

std::size_t TriangleMesh::side_of(std::int32_t triangle, std::uint32_t a, std::uint32_t b) const {
  const auto& corner = triangles_[std::size_t(triangle)].corner;
  for (std::size_t i = 0; i < 3; ++i)
    if (corner[after(i)] == a && corner[before(i)] == b) return i;
  throw std::logic_error("triangles do not share a side");
}

TriangleMesh::Found TriangleMesh::locate(const Point& x, std::int32_t start, bool up_to_marks) const {
  std::int32_t from = none;
  for (std::size_t steps = 0; steps < triangles_.size(); ++steps) {
    const auto& triangle = triangles_[std::size_t(start)];
    bool gone = false;
    for (std::size_t n = 0; n < 3 && !gone; ++n) {
      const std::size_t i = (n + steps) % 3;
      if (triangle.across[i] == from && from != none) continue;
      if (side(points_[triangle.corner[after(i)]], points_[triangle.corner[before(i)]], x) >= 0) continue;
      if (up_to_marks && triangle.mark[i] != unmarked) return {start, i};
      if (triangle.across[i] == none) return {};
      from = start, start = triangle.across[i], gone = true;
    }
    if (!gone) return {start, {}};
  }
  return {};
}

void TriangleMesh::begin(std::initializer_list<std::int32_t> triangles) {
  ++now_;
  rim_.clear();
  cavity_.assign(triangles);
  for (const auto t : triangles) stamp_[std::size_t(t)] = now_;
}

/// Extends the cavity beyond a side that x sees: a triangle whose circle holds x is changed too, where x sees all of
/// its sides. Sides are visited in their order about x; not by recursion, because a round plate has as many of these
/// triangles as corners.
void TriangleMesh::expand(std::int32_t triangle, std::size_t side_of_it, const Point& x) {
  sides_.assign(1, {triangle, side_of_it});
  while (!sides_.empty()) {
    const auto [t, i] = sides_.back();
    sides_.pop_back();
    const auto& own = triangles_[std::size_t(t)];
    const auto a = own.corner[after(i)], b = own.corner[before(i)];
    const auto beyond = own.across[i];
    if (own.mark[i] == unmarked && beyond != none && stamp_[std::size_t(beyond)] != now_ && in_circle(beyond, x)) {
      const auto j = side_of(beyond, b, a);
      const Point& apex = points_[triangles_[std::size_t(beyond)].corner[j]];
      if (side(points_[a], apex, x) > 0 && side(apex, points_[b], x) > 0) {
        stamp_[std::size_t(beyond)] = now_;
        cavity_.push_back(beyond);
        sides_.emplace_back(beyond, before(j)), sides_.emplace_back(beyond, after(j));
        continue;
      }
    }
    rim_.push_back({a, b, beyond, own.mark[i]});
  }
}

bool TriangleMesh::sees_rim(const Point& x) const {
  for (const auto& rim : rim_)
    if (side(points_[rim.from], points_[rim.to], x) <= 0) return false;
  return true;
}

bool TriangleMesh::carve(std::int32_t triangle, const Point& x) {
  begin({triangle});
  for (std::size_t i = 0; i < 3; ++i) expand(triangle, i, x);
  return sees_rim(x);
}

/// Triangles from x to all sides of the rim, which is a closed ring. `first_half`: of how many sides one half of the
/// rim consists that marked sides part from the other half; 0 without these. A half beside all triangles is missing.
void TriangleMesh::fill(const Point& x, std::size_t first_half, std::int32_t mark) {
  const auto v = std::uint32_t(points_.size());
  points_.push_back(x);
  const bool open = first_half == rim_.size();
  const bool inside = triangles_[std::size_t(cavity_.front())].inside;
  const bool other_inside = open ? inside : triangles_[std::size_t(cavity_[first_half > 0 ? 1 : 0])].inside;
  while (cavity_.size() < rim_.size()) {
    cavity_.push_back(std::int32_t(triangles_.size()));
    triangles_.emplace_back(), stamp_.push_back(now_);
  }
  const auto m = rim_.size();
  std::vector<std::size_t> both;  // rims on the two faces of one side
  for (std::size_t j = 0; j < m; ++j) {
    const auto& rim = rim_[j];
    const bool first = first_half > 0 && (j == 0 || j == first_half);
    const bool last = first_half > 0 && (j + 1 == first_half || j + 1 == m);
    std::int32_t next = cavity_[(j + 1) % m], previous = cavity_[(j + m - 1) % m];
    if (open && first) previous = none;
    if (open && last) next = none;
    if (rim.beyond != none && stamp_[std::size_t(rim.beyond)] == now_)
      both.push_back(j);
    else if (rim.beyond != none)
      triangles_[std::size_t(rim.beyond)].across[side_of(rim.beyond, rim.to, rim.from)] = cavity_[j];
    triangles_[std::size_t(cavity_[j])] = {{v, rim.from, rim.to},
                                           {rim.beyond, next, previous},
                                           {rim.mark, last ? mark : unmarked, first ? mark : unmarked},
                                           first_half > 0 && j >= first_half ? other_inside : inside};
  }
  for (const auto one : both) {
    const auto found = std::find_if(
        rim_.begin(), rim_.end(), [&](const Rim& rim) { return rim.from == rim_[one].to && rim.to == rim_[one].from; });
    if (found == rim_.end()) throw std::logic_error("a side of a crack has one face");
    triangles_[std::size_t(cavity_[one])].across[0] = cavity_[std::size_t(found - rim_.begin())];
  }
}

void TriangleMesh::insert(const Point& x) {
  fill(x, 0, unmarked);
}

bool TriangleMesh::halve(std::int32_t t, std::size_t i) {
  const auto a = triangles_[std::size_t(t)].corner[after(i)], b = triangles_[std::size_t(t)].corner[before(i)];
  const auto mark = triangles_[std::size_t(t)].mark[i];
  const auto other = triangles_[std::size_t(t)].across[i];
  const Point x = (points_[a] + points_[b]) / 2;
  if (x == points_[a] || x == points_[b]) return false;
  if (other == none)
    begin({t});
  else
    begin({t, other});
  const auto j = other == none ? 0 : side_of(other, b, a);
  expand(t, after(i), x), expand(t, before(i), x);
  const auto half = rim_.size();
  if (other != none) expand(other, after(j), x), expand(other, before(j), x);
  if (!sees_rim(x)) return false;
  fill(x, half, mark);
  return true;
}

/// (p, a, b) and (q, b, a) become (p, a, q) and (q, b, p).
void TriangleMesh::exchange(std::int32_t t, std::size_t i) {
  const auto n = triangles_[std::size_t(t)].across[i];
  const auto one = triangles_[std::size_t(t)];
  const auto j = side_of(n, one.corner[before(i)], one.corner[after(i)]);
  const auto other = triangles_[std::size_t(n)];
  const auto p = one.corner[i], a = one.corner[after(i)], b = one.corner[before(i)], q = other.corner[j];
  const auto link = [&](std::int32_t beyond, std::uint32_t from, std::uint32_t to, std::int32_t fresh) {
    if (beyond != none) triangles_[std::size_t(beyond)].across[side_of(beyond, to, from)] = fresh;
  };
  link(other.across[after(j)], a, q, t);
  link(one.across[after(i)], b, p, n);
  triangles_[std::size_t(t)] = {{p, a, q},
                                {other.across[after(j)], n, one.across[before(i)]},
                                {other.mark[after(j)], unmarked, one.mark[before(i)]},
                                one.inside};
  triangles_[std::size_t(n)] = {{q, b, p},
                                {one.across[after(i)], t, other.across[before(j)]},
                                {one.mark[after(i)], unmarked, other.mark[before(j)]},
                                one.inside};
}

void TriangleMesh::exchange_sides() {
  std::vector<std::int32_t> open(triangles_.size());
  for (std::size_t t = 0; t < open.size(); ++t) open[t] = std::int32_t(t);
  while (!open.empty()) {
    const auto t = open.back();
    open.pop_back();
    if (!triangles_[std::size_t(t)].inside) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& triangle = triangles_[std::size_t(t)];
      const auto n = triangle.across[i];
      if (triangle.mark[i] != unmarked || n == none) continue;
      const auto q =
          triangles_[std::size_t(n)].corner[side_of(n, triangle.corner[before(i)], triangle.corner[after(i)])];
      if (!in_circle(t, points_[q])) continue;
      exchange(t, i);
      open.push_back(n), open.push_back(t);
      break;
    }
  }
}

}  // namespace geometry
