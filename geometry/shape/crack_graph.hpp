#pragma once
#include <array>
#include <functional>
#include <map>

#include "geometry/shape/crack_path.hpp"

namespace geometry {

/// A crack of a lattice between two of its ends, straightened.
struct GraphLine {
  Polyline vertices;          // lattice units
  std::vector<double> times;  // per vertex: when the crack got there
  End front, back;
  double length = 0;  // of the straightened line
};

/// Cracks as the lattice has them: the sides between cells of neighbouring points that are parted. A corner of cells
/// where one such side ends is a tip, one where three meet a junction.
class CrackGraph {
public:
  using Corner = std::array<int, 2>;  // lattice units

  using Side = std::pair<Corner, Corner>;  // lower corner first

  /// Parts two points at a distance of one spacing [lattice units]. False where they were parted before.
  bool part(const Point& p, const Point& q, double time);
  std::size_t sides() const { return times_.size(); }
  /// Sides of the graph, those that follow each other on a straight line joined.
  std::vector<Side> runs() const;

  /// Lines between tips, mouths and junctions. Spurs and lone pieces of fewer than `least` sides are left out. A corner
  /// is a mouth where `inside` is false: not all four cells about it are of the plate.
  std::vector<GraphLine> lines(const std::function<bool(const Corner&)>& inside, std::size_t least = 3) const;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(times_);
  }

private:
  std::map<Side, double> times_;
};

}  // namespace geometry
