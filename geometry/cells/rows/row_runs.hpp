#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace geometry {

/// Columns `first` to below `second`.
using Columns = std::pair<long, long>;

/// Both ascending; what these return is, too, and parted from each other: what is in both, in either, which may overlap
/// in themselves, in the first alone.
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
  /// To the last row begun, to the right of all that it has. Throws std::length_error where numbers are used up.
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
  /// Those but for some, by ascending numbers, numbered anew.
  RowRuns except(std::span<const std::uint32_t> numbers) const;

private:
  std::vector<Run> runs_;
  std::vector<std::size_t> first_;  // per row
  std::uint32_t size_ = 0;
};

}  // namespace geometry
