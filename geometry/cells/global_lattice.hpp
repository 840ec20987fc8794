#pragma once
#include "geometry/cells/cells_part.hpp"
#include "geometry/cells/lattice_cells.hpp"

namespace geometry {

/// Points and cells of a plate on a lattice, stored as runs of its rows: takes memory for edges, cracks and rows alone,
/// and makes cells of any part of the plate.
class GlobalLattice {
public:
  /// Constructs the lattice of tessellation(). Throws std::invalid_argument.
  GlobalLattice(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing,
                const std::vector<Point>& singles);

  const LatticeUnits& units() const { return units_; }
  std::size_t size() const { return lattice_.points.size() + lattice_.others.size(); }
  /// Lattice points, and the others, which are numbered after these [spacings].
  const RowRuns& points() const { return lattice_.points; }
  const std::vector<Point>& others() const { return lattice_.others; }
  /// The longest side of a triangle [spacings]; of a square, where there is none.
  double longest_side() const { return longest_side_; }
  /// The column and row of the last points.
  Cell last() const;

  Tessellation cells() const;
  /// Cells with a corner in a box, in global order, and their points.
  CellsPart cells_at(const CellBox& box) const;
  /// The first point with squares all about it and its neighbours.
  std::optional<Cell> first_inside() const;

private:
  friend class CellsAt;
  using AtPlace = std::pair<std::pair<long, long>, Tessellation::Square>;  // row and column of a square; its corners

  void part(LatticeCells cells);
  Tessellation::Square square(long i, long j) const;
  bool inside(long i, long j) const;  // have four squares this point of the lattice?

  LatticeUnits units_;
  LatticeCells lattice_;         // without the pieces of curves
  std::vector<AtPlace> parted_;  // squares with corners that are no points of the lattice, row by row
  std::vector<Tessellation::Border> borders_;
  std::vector<std::string> names_;
  double longest_side_ = 1;
};

}  // namespace geometry
