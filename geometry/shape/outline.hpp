#pragma once
#include <Eigen/Core>
#include <optional>
#include <ranges>
#include <string>
#include <variant>
#include <vector>

/// Outlines, cracks, point clouds and families. Knows no mechanics. Everything here is independent of units; exact
/// tests are made in lattice units (see LatticeUnits).
namespace geometry {

using Point = Eigen::Vector2d;

/// A closed polygon; edge i runs from vertex i to vertex i + 1 (cyclic) and is called edge_names[i].
struct Polygon {
  std::vector<Point> vertices;
  std::vector<std::string> edge_names;
};

struct Circle {
  Point centre;
  double radius;
  std::string name;
};

using Hole = std::variant<Polygon, Circle>;

/// The plate's shape: outer boundary (counter-clockwise) and holes.
struct Outline {
  Polygon outer;
  std::vector<Hole> holes;
};

/// The holes that are circles.
inline auto circles(const Outline& outline) {
  return outline.holes | std::views::filter([](const Hole& hole) { return std::holds_alternative<Circle>(hole); }) |
         std::views::transform([](const Hole& hole) -> const Circle& { return std::get<Circle>(hole); });
}

/// A straight piece of the boundary with the plate on its left.
struct Edge {
  std::string name;
  Point from, to;
};

/// Error of a geometry: `where` is "outline", "holes[1]" or "cracks[0]".
struct GeometryError {
  std::string where;
  std::string what;
};

/// The rectangle with the edges left, right, bottom, top.
Outline rectangle(double xmin, double ymin, double xmax, double ymax);

/// Straight edges of the outer polygon and of polygonal holes, each with the plate on its left.
std::vector<Edge> straight_edges(const Outline& outline);

/// The distinct names of all edges and holes, in order of appearance.
std::vector<std::string> edge_names(const Outline& outline);

/// Length of the straight edges and circles called `name`.
double edge_length(const Outline& outline, const std::string& name);

/// True where the point is strictly inside the plate. Exact: a point on the boundary is outside.
bool contains(const Outline& outline, const Point& point);

/// Corners of a closed line, counter-clockwise, at which its inside takes more than 200 degrees: fields of a plate are
/// singular there.
std::vector<Point> reentrant_corners(const std::vector<Point>& outer);

/// Area of the part of the axis-parallel square about `centre` that lies in the plate.
double clipped_cell_area(const Outline& outline, const Point& centre, double side);

/// Area of the plate.
double area(const Outline& outline);

/// True where the straight segment between two points inside the plate leaves it, through a hole or past a re-entrant
/// corner. Exact; a segment that merely touches the boundary does not leave.
bool leaves(const Outline& outline, const Point& p, const Point& q);

/// True where the segments pq and ab share a point. Exact.
bool meet(const Point& p, const Point& q, const Point& a, const Point& b);

/// Errors of the outline and its holes: fewer than three vertices, repeated vertices, self-crossing, clockwise, no
/// area, radius <= 0, holes outside, crossing the outline or each other.
std::vector<GeometryError> errors(const Outline& outline);

/// Lower left and upper right corner of the bounding box of points, one at least.
std::pair<Point, Point> bounding_box(const std::vector<Point>& points);
std::pair<Point, Point> bounding_box(const Outline& outline);

/// A length that counts as nothing beside the outline: the noise of decimals.
double tolerance(const Outline& outline);

}  // namespace geometry
