#include "geometry/cells/delaunay.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <stdexcept>
#include <unordered_map>

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

Triangulated delaunay(const std::vector<Point>& points, const std::vector<std::array<std::uint32_t, 2>>& pieces) {
  std::vector<std::pair<Kernel::Point_2, std::uint32_t>> places;
  for (const auto& x : points) places.emplace_back(Kernel::Point_2(x.x(), x.y()), std::uint32_t(places.size()));
  Triangulation triangulation;
  triangulation.insert(places.begin(), places.end());
  if (triangulation.number_of_vertices() != points.size()) throw std::invalid_argument("two points at one place");
  std::vector<Triangulation::Vertex_handle> vertex(points.size());
  for (const auto v : triangulation.finite_vertex_handles()) vertex[v->info()] = v;
  try {
    for (const auto& [from, to] : pieces) triangulation.insert_constraint(vertex[from], vertex[to]);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw std::invalid_argument("edges and cracks cross each other within a spacing");
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

}  // namespace geometry
