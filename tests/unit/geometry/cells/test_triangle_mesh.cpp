#include <random>

#include "geometry/cells/triangulation.hpp"
#include "geometry/shape/predicates.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

/// A square of 4 x 4 with a hole and a crack, ten pieces in all.
Curves square() {
  Curves result;
  result.nodes = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {2.5, 3}, {3, 3.2}, {3.5, 3.4}};
  result.pieces = {{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 0, 0},  {4, 5, 1},
                   {5, 6, 1}, {6, 7, 1}, {7, 4, 1}, {8, 9, -1}, {9, 10, -1}};
  return result;
}

struct Found {
  int parted = 0, turned = 0;  // neighbours that do not know each other, triangles that are not counter-clockwise
  double area = 0, edges = 0, cracks = 0;
};

Found found(const TriangleMesh& mesh) {
  Found result;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto& triangle = mesh.triangles()[t];
    const auto at = [&](std::size_t i) { return mesh.points()[triangle.corner[i % 3]]; };
    result.turned += side(at(0), at(1), at(2)) <= 0;
    if (triangle.inside) result.area += cross(at(1) - at(0), at(2) - at(0)) / 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = (at(i + 1) - at(i + 2)).norm();
      if (triangle.inside && triangle.mark[i] >= 0) result.edges += length;
      if (triangle.inside && triangle.mark[i] == Curves::crack) result.cracks += length;
      if (triangle.across[i] == TriangleMesh::none) continue;
      const auto& other = mesh.triangles()[std::size_t(triangle.across[i])];
      const auto back = std::find(other.across.begin(), other.across.end(), std::int32_t(t)) - other.across.begin();
      result.parted += back == 3 || other.mark[std::size_t(back)] != triangle.mark[i];
    }
  }
  return result;
}

void check(const TriangleMesh& mesh) {
  const auto all = found(mesh);
  CHECK(all.parted == 0);
  CHECK(all.turned == 0);
  CHECK(all.area == Approx(15).epsilon(1e-12));
  CHECK(all.edges == Approx(20).epsilon(1e-12));
  CHECK(all.cracks == Approx(2 * ((Point(0.5, 0.2)).norm() * 2)).epsilon(1e-12));
}

}  // namespace

TEST_CASE("a triangle mesh keeps its curves and its neighbours while points are added and sides halved") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 4);
  TriangleMesh mesh(square());
  check(mesh);
  std::size_t added = 0, halved = 0;
  for (int n = 0; n < 2000; ++n) {
    const Point x(uniform(random), uniform(random));
    const auto at = mesh.locate(x, 0, false);
    REQUIRE(at.triangle != TriangleMesh::none);
    if (n % 7 > 0) {
      if (mesh.carve(at.triangle, x)) mesh.insert(x), ++added;
    } else {
      const auto mark = mesh.triangles()[std::size_t(at.triangle)].mark;
      for (std::size_t i = 0; i < 3; ++i)
        if (mark[i] != TriangleMesh::unmarked) {
          halved += mesh.halve(at.triangle, i);
          break;
        }
    }
  }
  CHECK(added > 1600);
  CHECK(halved > 5);  // measured: 11
  check(mesh);
}

TEST_CASE("sides are exchanged until no circle holds a point that is seen") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 4);
  TriangleMesh mesh(square());
  for (int n = 0; n < 300; ++n) {
    const Point x(uniform(random), uniform(random));
    if (const auto at = mesh.locate(x, 0, false); mesh.carve(at.triangle, x)) mesh.insert(x);
  }
  // towards the middle by a hundredth: small enough that nothing turns over
  for (std::uint32_t k = 11; k < mesh.points().size(); ++k)
    mesh.move(k, mesh.points()[k] + 1e-4 * (Point(2, 2) - mesh.points()[k]));
  REQUIRE(found(mesh).turned == 0);
  mesh.exchange_sides();
  check(mesh);
  int inside_circles = 0;
  for (const auto& triangle : mesh.triangles())
    for (std::size_t i = 0; i < 3; ++i) {
      if (!triangle.inside || triangle.mark[i] != TriangleMesh::unmarked || triangle.across[i] == TriangleMesh::none)
        continue;
      const auto& other = mesh.triangles()[std::size_t(triangle.across[i])];
      for (const auto k : other.corner) {
        if (std::find(triangle.corner.begin(), triangle.corner.end(), k) != triangle.corner.end()) continue;
        const Point a = mesh.points()[triangle.corner[0]] - mesh.points()[k],
                    b = mesh.points()[triangle.corner[1]] - mesh.points()[k],
                    c = mesh.points()[triangle.corner[2]] - mesh.points()[k];
        const double in = a.squaredNorm() * cross(b, c) + b.squaredNorm() * cross(c, a) + c.squaredNorm() * cross(a, b);
        inside_circles += in > 1e-12;
      }
    }
  CHECK(inside_circles == 0);
}

TEST_CASE("a walk up to marks says which one is in the way") {
  const TriangleMesh mesh(square());
  const auto start = mesh.locate({0.5, 0.5}, 0, false).triangle;
  const auto through = mesh.locate({1.5, 1.5}, start, true);
  REQUIRE(through.blocked);
  CHECK(mesh.triangles()[std::size_t(through.triangle)].mark[*through.blocked] == 1);
  CHECK_FALSE(mesh.locate({0.6, 0.5}, start, true).blocked);
  CHECK(mesh.locate({5, 5}, start, false).triangle == TriangleMesh::none);
}

TEST_CASE("triangles belong to the plate by the edges about them, not by their places") {
  // the middle of the lower edge lies inwards or outwards by a rounding: no sliver beside it is taken for the plate
  for (const double off : {-1e-16, 0.0, 1e-16, 1e-12}) {
    const std::vector<Point> points{{0, 0}, {1, off}, {2, 0}, {2, 2}, {0, 2}};
    const std::vector<Curves::Piece> pieces{{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 0, 0}};
    const auto all = required_triangles(points, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}});
    const auto inside = within(all, fences(pieces));
    CHECK(std::count(inside.begin(), inside.end(), 1) == 3);
  }
  const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
  const auto all = required_triangles(points, {{0, 1}, {1, 2}, {2, 0}});
  CHECK_THROWS_AS(within(all, {{0, 1, true, false}, {1, 2, false, true}, {2, 0, true, false}}), std::logic_error);
}

TEST_CASE("points at one place and pieces that cross cannot be triangulated, and the reason is told") {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto reason = [](const auto& found) { return std::get<std::string>(found); };
  CHECK(reason(delaunay({{0, 0}, {1, 0}, {0, 1}, {1, 0}}, {})) == "two points at one place");
  CHECK(reason(delaunay(square, {{0, 2}, {1, 3}})) == "edges and cracks cross each other within a spacing");
  CHECK(std::get<Triangulated>(delaunay(square, {{0, 2}})).corners.size() == 2);
  CHECK_THROWS_AS(required_triangles(square, {{0, 2}, {1, 3}}), std::invalid_argument);
}
