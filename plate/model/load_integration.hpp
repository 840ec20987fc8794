#pragma once
#include <functional>
#include <string>
#include <vector>

#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/crack_path.hpp"
#include "geometry/shape/outline.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/point_map.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Tessellation;
}

namespace plate {

/// Integrals of a function f over a part of the plate: of f, of f (x - about) and of |f|, and the possible error of the
/// first where halving triangles did not help.
struct Integral {
  double value = 0;
  geometry::Point first{0, 0};
  double size = 0, error = 0;

  Integral& operator+=(const Integral& other);
};

/// Integrates over polygons, each as if it stood alone. Triangles are parted into four until that changes an integral
/// by less than 1e-4 of what the largest |f| of the polygon so far would give there, at most five times more than once:
/// a jump of f is placed within a hundredth of a triangle, and what is narrower than a tenth of it may be missed.
class Cubature {
public:
  using Function = std::function<double(const geometry::Point&)>;
  explicit Cubature(Function f) : f_(std::move(f)) {}

  /// `ring`: a polygon that is seen as a whole from its middle.
  Integral operator()(const std::vector<geometry::Point>& ring, const geometry::Point& about);

private:
  struct Triangle;
  Integral rule(const Triangle& triangle, const geometry::Point& about);
  Integral refined(const Triangle& triangle, const Integral& coarse, const geometry::Point& about, int depth);

  Function f_;
  double largest_ = 0;  // |f|, of the polygon in hand
};

/// A short piece of an edge: its middle, its outward normal times its length.
struct EdgePiece {
  geometry::Point middle;
  geometry::Point normal;
};

/// Pieces of one straight edge or circle, with the points of the plate near it.
struct EdgeBorder {
  std::vector<EdgePiece> pieces;
  std::vector<std::uint32_t> near;
};

/// Borders of all edges of a name; eight pieces per spacing, so that each lies in one cell where the edge follows the
/// lattice. `outline` in the cloud's own units; `reach` of the points near it [spacings]. Throws std::invalid_argument
/// for an edge without points beside it.
std::vector<EdgeBorder> edge_borders(const std::string& name, const geometry::Cloud& cloud,
                                     const geometry::Outline& outline, double reach = 2);

/// Returns the one of `points` that is nearest to x.
std::uint32_t nearest(const std::vector<std::uint32_t>& points, const geometry::Cloud& cloud, const geometry::Point& x);

/// Loads that are spread over a part of the plate or along a line, as nodal forces that have their resultants and the
/// moments of these (conjugate to w, theta_x, theta_y) [3 x points].

/// A force F at `lever` from the point: by w(lever) = w + lever . psi it is F on w and a couple on the rotations.
PointValues moved_force(double force, const geometry::Point& lever);

/// Adds a pressure that varies, or that acts on a patch: to every point what acts on its cell, exact for linear
/// pressures and polygons but for cells that the outline cuts, where it is spread as over the whole cell. Throws
/// FormulaError.
void add_pressure(const Pressure& load, const geometry::Cloud& cloud, const PointMap& map, Forces& forces);

/// Adds a pressure to the corners of cells, by the linear function that corners carry.
void add_pressure(const Pressure& load, const geometry::Tessellation& cells, const PointMap& map, Forces& forces);

/// A short piece of a line, and the point nearest to its middle.
struct LinePiece {
  std::size_t point;
  geometry::Point middle, way;  // way: from its begin to its end [length]
};

/// Splits a line into pieces of an eighth of a spacing at most, as far as it was discretised. No piece crosses a crack,
/// and the point of a piece lies on the same side of all cracks as the piece.
/// @throws Refused  where a piece has no point of the plate within two spacings
std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const geometry::Cloud& cloud,
                                   const std::vector<geometry::CrackPath>& cracks);
/// Returns the pieces of a line on points that lie on the edges.
std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const geometry::Tessellation& cells);

/// Adds a line load by the pieces of its line.
void add_line_load(const LineLoad& load, const geometry::Cloud& cloud, const std::vector<geometry::CrackPath>& cracks,
                   Forces& forces);
void add_line_load(const LineLoad& load, const geometry::Tessellation& cells, Forces& forces);

}  // namespace plate
