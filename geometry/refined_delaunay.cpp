#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/lloyd_optimize_mesh_2.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "geometry/delaunay.hpp"
#include "geometry/predicates.hpp"

namespace geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                         CGAL::Delaunay_mesh_face_base_2<Kernel>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

Point to_point(const Kernel::Point_2& x) {
  return {x.x(), x.y()};
}

/// Triangles no larger than wanted, with angles of 20.7 degrees and more where the curves allow it.
class Criteria {
public:
  using Triangulation = geometry::Triangulation;
  /// Mean side over what is wanted, squared sine of the smallest angle.
  using Quality = std::pair<double, double>;

  explicit Criteria(const Sizing& sizing) : sizing_(&sizing) {}

  class Is_bad {
  public:
    explicit Is_bad(const Sizing& sizing) : sizing_(&sizing) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const {
      if (quality.first > 1) return CGAL::Mesh_2::IMPERATIVELY_BAD;
      return quality.second < least_square_of_sine ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }

    CGAL::Mesh_2::Face_badness operator()(const Face& face, Quality& quality) const {
      const Point a = to_point(face->vertex(0)->point()), b = to_point(face->vertex(1)->point()),
                  c = to_point(face->vertex(2)->point());
      std::array<double, 3> squares{(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
      std::sort(squares.begin(), squares.end());
      const auto [shortest, middle, longest] = squares;
      const double twice = cross(b - a, c - a), wanted = (*sizing_)((a + b + c) / 3);
      // the mean side is what counts; Lloyd's optimisation evens them out
      quality = {std::sqrt(std::cbrt(shortest * middle * longest)) / (1.15 * wanted),
                 twice * twice / (middle * longest)};
      return (*this)(quality);
    }

  private:
    static constexpr double least_square_of_sine = 0.125;
    const Sizing* sizing_;
  };

  Is_bad is_bad_object() const { return Is_bad(*sizing_); }

private:
  const Sizing* sizing_;
};

/// The halves of a piece, from vertex to vertex along constrained sides.
std::vector<Vertex> along(const Triangulation& triangulation, Vertex from, Vertex to,
                          const std::map<Vertex, std::uint32_t>& nodes) {
  const Point way = to_point(to->point()) - to_point(from->point());
  std::vector<Vertex> result{from};
  while (result.back() != to) {
    const Vertex at = result.back();
    Vertex next;
    double straightest = 0.9;
    auto edge = triangulation.incident_edges(at);
    const auto first = edge;
    do {
      if (triangulation.is_infinite(*edge) || !edge->first->is_constrained(edge->second)) continue;
      const auto other = edge->first->vertex(Triangulation::cw(edge->second)) == at
                             ? edge->first->vertex(Triangulation::ccw(edge->second))
                             : edge->first->vertex(Triangulation::cw(edge->second));
      if (other != to && nodes.contains(other)) continue;
      const double cosine = (to_point(other->point()) - to_point(at->point())).normalized().dot(way.normalized());
      if (cosine > straightest) straightest = cosine, next = other;
    } while (++edge != first);
    if (next == Vertex()) throw std::logic_error("a piece of a curve was lost in the triangulation");
    result.push_back(next);
  }
  return result;
}

}  // namespace

Triangles refined_delaunay(const Curves& curves, const Sizing& sizing) {
  Triangulation triangulation;
  std::vector<Vertex> vertex;
  for (const auto& x : curves.nodes) vertex.push_back(triangulation.insert({x.x(), x.y()}));
  try {
    for (const auto& piece : curves.pieces) triangulation.insert_constraint(vertex[piece.from], vertex[piece.to]);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw std::invalid_argument("edges and cracks cross each other within a spacing");
  }
  // a seed in every hole: the middle of a triangle there
  std::vector<Kernel::Point_2> seeds;
  for (const auto face : triangulation.finite_face_handles()) {
    const auto middle = CGAL::centroid(triangulation.triangle(face));
    if (!contains(curves.outline, to_point(middle))) seeds.push_back(middle);
  }
  CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation, Criteria(sizing));
  mesher.set_seeds(seeds.begin(), seeds.end(), false);
  mesher.refine_mesh();
  CGAL::lloyd_optimize_mesh_2(triangulation, CGAL::parameters::max_iteration_number = 10,
                              CGAL::parameters::seeds_begin = seeds.begin(), CGAL::parameters::seeds_end = seeds.end());

  Triangles result;
  std::map<Vertex, std::uint32_t> index, nodes;
  for (std::uint32_t n = 0; n < vertex.size(); ++n) nodes[vertex[n]] = n;
  const auto number = [&](Vertex v) {
    const auto [entry, fresh] = index.try_emplace(v, std::uint32_t(result.points.size()));
    if (fresh) result.points.push_back(LatticeUnits{}.to_lattice(to_point(v->point())));
    return entry->second;
  };
  for (const auto face : triangulation.finite_face_handles())
    if (contains(curves.outline, to_point(CGAL::centroid(triangulation.triangle(face)))))
      result.triangles.push_back({number(face->vertex(0)), number(face->vertex(1)), number(face->vertex(2))});
  for (const auto& piece : curves.pieces) {
    const auto halves = along(triangulation, vertex[piece.from], vertex[piece.to], nodes);
    for (std::size_t i = 0; i + 1 < halves.size(); ++i)
      result.pieces.push_back({number(halves[i]), number(halves[i + 1]), piece.edge});
  }
  return result;
}

}  // namespace geometry
