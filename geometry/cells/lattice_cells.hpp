#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/cells/uncracked_cells.hpp"
#include "geometry/lattice/curves.hpp"

namespace geometry {

/// Columns `first` to below `second`.
using Columns = std::pair<long, long>;

/// Set operations on columns, both arguments ascending: what is in both, in either (each may overlap itself), in the
/// first alone. The results are ascending and disjoint.
std::vector<Columns> common(const std::vector<Columns>& one, const std::vector<Columns>& other);
std::vector<Columns> joined(const std::vector<Columns>& one, const std::vector<Columns>& other);
std::vector<Columns> without(const std::vector<Columns>& one, const std::vector<Columns>& other);

/// Places of a lattice, numbered row by row, kept as runs of columns: as much memory as the runs are many.
class RowRuns {
public:
  struct Run {
    std::int32_t from, to;  // columns from ... to - 1
    std::uint32_t number;   // of the first
  };

  void begin_row() { first_.push_back(runs_.size()); }
  /// Adds columns to the last row begun, to the right of all that it has. Throws std::length_error where numbers are
  /// used up.
  void add(const Columns& columns);

  long rows() const { return long(first_.size()); }
  std::uint32_t size() const { return size_; }
  /// Empty beside the rows.
  std::span<const Run> row(long j) const;
  std::vector<Columns> columns(long j) const;
  std::optional<std::uint32_t> at(long i, long j) const;
  /// The run of the row that has the column.
  const Run* run_at(long i, long j) const;
  /// Column and row of a number.
  std::pair<long, long> place(std::uint32_t number) const;
  /// Copy without the places of the given ascending numbers, numbered anew.
  RowRuns except(std::span<const std::uint32_t> numbers) const;

private:
  std::vector<Run> runs_;
  std::vector<std::size_t> first_;  // per row
  std::uint32_t size_ = 0;
};

/// Lattice points and squares that curves come near to, by rows: as many as the curves are long.
class NearCurves {
public:
  struct Mark {
    std::int32_t row, column;
    bool left_out;  // so near a curve that it is none of its own
  };

  /// Columns and rows of squares.
  NearCurves(const Curves& curves, double clearance, long columns, long rows);

  /// Lattice points near an edge, or too near a curve to stay, by ascending columns.
  std::span<const Mark> row(long j) const;
  bool near(long i, long j) const;
  /// Squares that a curve runs through or a node lies in, by ascending columns.
  std::vector<long> blocked(long j) const;

private:
  std::vector<Mark> marks_;
  std::vector<std::pair<long, long>> blocked_;  // row, column
};

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
