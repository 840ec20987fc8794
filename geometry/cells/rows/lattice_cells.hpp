#pragma once
#include "geometry/cells/rows/row_runs.hpp"
#include "geometry/cells/untied_cells.hpp"

namespace geometry {

/// Cells on a lattice before cracks part them, in lattice units: of what is inside only the runs of its rows.
struct LatticeCells {
  RowRuns points;             // of the lattice
  RowRuns squares;            // by their lower left corners
  std::vector<Point> others;  // points beside the lattice, numbered after its own
  std::vector<Tessellation::Triangle> triangles;
  std::vector<Curves::Piece> pieces;  // by points
  std::vector<std::uint32_t> about;   // points that triangles may be about, ascending: others have squares

  Point position(std::uint32_t k) const;
  /// The corners of a square that is there.
  Tessellation::Square square(long i, long j) const;
  Cells cells() const;
};

/// Squares of the lattice where nothing disturbs it, triangles elsewhere. `clearance`: between a lattice point and a
/// curve that does not run through it; nearer ones are left out [spacings].
LatticeCells lattice_cells(const Curves& curves, double clearance);

}  // namespace geometry
