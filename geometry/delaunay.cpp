#include "geometry/delaunay.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <stdexcept>

namespace geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

}  // namespace

std::vector<std::array<std::uint32_t, 3>> delaunay(const std::vector<Point>& points,
                                                   const std::vector<std::array<std::uint32_t, 2>>& pieces) {
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
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles())
    triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

}  // namespace geometry
