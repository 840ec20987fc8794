#pragma once
#include <functional>
#include <vector>

#include "geometry/shape/outline.hpp"

namespace plate {
class Communicator;
struct Mesh;
}  // namespace plate

namespace post {

/// Global order of the points of a distributed plate: row by row from the lower left, or by their numbers. Each rank
/// knows the positions of its owned points, by pieces of a row.
class PointOrder {
public:
  /// Constructs from the owned points of the rank in that order [length]; of a row of the lattice all ranks have the
  /// same y. Collective. `all` must outlive this.
  PointOrder(const plate::Communicator& all, const std::vector<geometry::Point>& own);
  /// Constructs from the global numbers of the owned points, ascending.
  PointOrder(const plate::Communicator& all, const std::vector<std::uint32_t>& numbers);

  /// Number of points of all ranks.
  std::size_t points() const { return points_; }

  /// Gathers the values of `count` points from `first` on, `width` of each, point by point: on the first rank; empty on
  /// the others. `numbers(k, to)` gives those of the rank's own point k. Collective: every rank must call it.
  std::vector<double> at_first(std::size_t first, std::size_t count, std::size_t width,
                               const std::function<void(std::size_t k, double* to)>& numbers) const;

private:
  /// Run of owned points that follow each other in the global order.
  struct PointRun {
    std::size_t first, begin, points;  // first: among all; begin: among the own
  };

  const plate::Communicator& all_;
  std::size_t points_ = 0;
  std::vector<PointRun> own_;
};

/// The order of the points of a mesh whose owned points come first.
PointOrder order_of(const plate::Communicator& all, const plate::Mesh& mesh);

}  // namespace post
