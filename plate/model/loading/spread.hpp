#pragma once
#include "geometry/shape/crack_path.hpp"
#include "plate/model/loads.hpp"
#include "plate/model/state.hpp"

namespace geometry {
struct Cloud;
struct Tessellation;
}  // namespace geometry

namespace plate {

/// Loads that are spread over a part of the plate or along a line, as nodal forces that have their resultants and the
/// moments of these (conjugate to w, theta_x, theta_y) [3 x points].

/// A force F at `lever` from the point: by w(lever) = w + lever . psi it is F on w and a couple on the rotations.
Eigen::Vector3d moved_force(double force, const geometry::Point& lever);

/// Adds a pressure that varies, or that acts on a patch: to every point what acts on its cell, exact for linear
/// pressures and polygons but for cells that the outline cuts, where it is spread as over the whole cell. Throws
/// FormulaError. `own`: points that no other process has, empty: all.
void add_pressure(const Load& load, const geometry::Cloud& cloud, const std::vector<char>& own, Forces& forces);

/// The same to the corners of cells, by the linear function that corners carry.
void add_pressure(const Load& load, const geometry::Tessellation& cells, const std::vector<char>& own, Forces& forces);

/// A short piece of a line, and the point nearest to its middle.
struct LinePiece {
  std::size_t point;
  geometry::Point middle, way;  // way: from its begin to its end [length]
};

/// A line in pieces of an eighth of a spacing at most, as far as it was seeded. No piece crosses a crack, and the point
/// of a piece lies on the same side of all cracks as the piece.
/// @throws std::invalid_argument  where a piece has no point of the plate within two spacings
std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const geometry::Cloud& cloud,
                                   const std::vector<geometry::CrackPath>& cracks);
/// The same of points that lie on the edges.
std::vector<LinePiece> line_pieces(const geometry::Polyline& line, const geometry::Tessellation& cells);

/// Adds a line load by the pieces of its line.
void add_line_load(const Load& load, const geometry::Cloud& cloud, const std::vector<geometry::CrackPath>& cracks,
                   Forces& forces);
void add_line_load(const Load& load, const geometry::Tessellation& cells, Forces& forces);

}  // namespace plate
