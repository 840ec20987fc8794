#pragma once
#include <array>

#include "geometry/lattice/curves.hpp"
#include "geometry/lattice/families.hpp"
#include "geometry/lattice/grouped.hpp"

namespace geometry {

/// Points on all edges, holes and both faces of every crack, and the cells between them: squares of the lattice and
/// triangles. A crack is where neighbouring cells have points of their own at the same places; at a tip they share one.
struct Tessellation {
  using Square = std::array<std::uint32_t, 4>;    // counter-clockwise from the lower left
  using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise
  struct Border {
    std::uint32_t from, to;  // the plate on the left
    std::int32_t edge;       // which of the names; -1: the face of a crack
  };

  LatticeUnits units;
  bool graded = false;           // the distance of points varies
  std::vector<Point> positions;  // [length]
  std::vector<Square> squares;
  std::vector<Triangle> triangles;
  std::vector<Border> borders;
  std::vector<std::string> names;  // of the edges
  /// Positions from `units.origin` on [length]: differences of these are as exact as numbers allow, those of
  /// `positions` are not where the plate is far from the origin.
  std::vector<Point> local;

  /// Portion of a plate on a distributed lattice that one rank holds.
  struct Window {
    CellBox about;  // the points nearest to a place there are here, and the cells about it
    Cell last;      // the column and row of the last points of the global plate
  };
  std::optional<Window> window = {};  // absent: these are all
  bool sees(const Point& x) const { return !window || window->about.contains(cell_of(units.to_lattice(x))); }
};

/// Moves a point [length].
inline void move(Tessellation& cells, std::size_t k, const Point& by) {
  cells.positions[k] += by, cells.local[k] += by;
}

/// Grading of the distance between points: one spacing, or less about tips and holes and growing with the distance from
/// them.
struct Grading {
  std::optional<double> at_tips, at_holes;  // [length]
  double growth = 0.2;                      // of the distance of neighbouring points per distance from there
  /// Places of forces: so near to a tip that points are less than a spacing apart, they are as near there as about a
  /// tip, or growth^2 times the distance from it where that is more. Not closer to a tip than at_tips.
  std::vector<Point> forces = {};
  /// Parts of the plate on whose boundary points are as near as at holes.
  std::vector<Hole> parts = {};
  /// An edge of the outer polygon beside which something changes within a layer.
  struct Edge {
    std::string name;
    double spacing;  // [length]
    double layer;    // within this distance from the edge spacings grow by `growth` [length]
    double beyond;   // their growth farther away
  };
  std::vector<Edge> edges = {};
  /// Corners that reach into the plate, on which points are at_corners apart [length].
  std::vector<Point> corners = {};
  double at_corners = 0;
};

/// The lattice with its squares wherever nothing disturbs it, and triangles (constrained Delaunay) between it and
/// edges, holes and cracks that do not follow it; lattice points closer than 0.6 spacings to those are left out. With a
/// grading, triangles all over. `singles`: places that get a point of their own. Throws std::invalid_argument where the
/// pieces of edges and cracks cross each other: circles are polygons here.
Tessellation tessellation(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing,
                          const std::vector<Point>& singles, const Grading& grading);

/// The points that share a cell with each point. Points inside the lattice share bonds.
Families cell_families(const Tessellation& tessellation);

/// Returns cell_families() with bonds stored separately for every point.
Families exact_cell_families(const Tessellation& tessellation);

/// Positions, those on the faces of cracks moved into their cells by 2e-6 of the distance to the next points of the
/// crack: so they tell on which face they are.
std::vector<Point> positions_inside_faces(const Tessellation& tessellation);

/// Finds the cell about a place.
class CellLocator {
public:
  /// The corners of a cell with the weights of linear (triangle) or bilinear (square) interpolation.
  struct Found {
    std::size_t count = 0;
    std::array<std::uint32_t, 4> points{};
    std::array<double, 4> weights{};
  };

  /// `cells` must outlive this.
  explicit CellLocator(const Tessellation& cells);

  /// The cell about `seen`, or nearest to it, with the weights for `at` [length].
  Found operator()(const Point& seen, const Point& at) const;

private:
  Found weighted(std::uint32_t cell, const Point& at) const;
  long width() const { return high_[0] - low_[0] + 1; }
  long bucket(long column, long row) const { return (row - low_[1]) * width() + column - low_[0]; }

  const Tessellation& cells_;
  Cell low_, high_;                 // the first and last columns and rows of buckets
  Cell last_;                       // of the whole plate
  Grouped<std::uint32_t> members_;  // of buckets, one spacing wide: numbers of squares, then of triangles
};

/// Estimates the number of points of a plate from its area, and from the integral of what graded points have more about
/// tips and holes: within 25 % where a plate is some ten spacings wide.
double expected_points(const Outline& outline, const std::vector<Tip>& tips, double spacing, const Grading& grading);

}  // namespace geometry
