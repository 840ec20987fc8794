#pragma once
#include <map>

#include "geometry/cells/global_lattice.hpp"

namespace geometry {

/// Distribution of the points of a plate on a lattice among parts: shared_out() without the points. A part is what is
/// between two rows and two column blocks; of a single row it may be some of its points.
class DistributedLattice {
public:
  /// `global` must outlive this.
  DistributedLattice(const GlobalLattice& global, int parts);

  struct Part {
    std::size_t points = 0;
    Point low{0, 0}, high{0, 0};  // of its points [length]
  };
  const Part& part(int one) const { return parts_[std::size_t(one)]; }
  /// Returns the part that each point of `some`, a portion of the global plate, belongs to [points of `some`].
  std::vector<int> owners(const CellsPart& some) const;

private:
  /// Split of a box by a column block or by y; what begins there or beyond is of the upper half.
  struct Cut {
    int axis = 0;
    long column_block = 0;
    double y = 0;
    int lower = 0, upper = 0;  // the cuts of both halves; below zero: -1 - part, or `by_points`
  };
  static constexpr int by_points = -1 << 30;
  struct Box;
  struct Count;

  int share_out(const Box& box, int first, int parts);
  int share_row(const Box& box, int first, int parts);
  static std::optional<Cut> halved(const Count& count, double share);
  Count counted(const Box& box) const;
  template <typename Visit>
  void for_runs(const Box& box, const Visit& visit) const;
  template <typename Visit>
  void for_others(const Box& box, const Visit& visit) const;

  const GlobalLattice& global_;
  std::vector<Part> parts_;
  std::vector<Cut> cuts_;
  int begin_ = 0;                        // as Cut::lower
  std::map<std::uint32_t, int> single_;  // parts of points of rows that are parted themselves
};

}  // namespace geometry
