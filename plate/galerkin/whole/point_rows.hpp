#pragma once
#include "plate/model/state.hpp"
#include "plate/solve/matrices/point_matrix.hpp"

namespace plate {

/// Products with an assembled stiffness, each point by the blocks of its own row: for plates whose families share no
/// weights. Any number of threads gives the same bits.
class PointRows {
public:
  /// `points`: those whose rows are wanted; the other columns of a result are left as they are.
  PointRows(PointMatrix matrix, std::vector<std::uint32_t> points);

  const PointMatrix& matrix() const { return matrix_; }
  void internal_force(const State& state, Forces& forces) const;    // -K state
  void absolute_product(const State& state, Forces& forces) const;  // |K| state
  void diagonal(Forces& diagonal) const;
  std::size_t bytes() const;

private:
  /// A block of a row: of the lower triangle, or the transpose of one.
  struct Entry {
    std::uint32_t point;
    bool transposed;
    std::size_t block;
  };
  template <typename Add>
  void gather(Forces& result, const Add& add) const;

  PointMatrix matrix_;
  std::vector<std::uint32_t> points_;
  std::vector<std::size_t> first_;  // per point of those [points_ + 1]
  std::vector<Entry> entries_;
};

}  // namespace plate
