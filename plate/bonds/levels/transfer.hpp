#pragma once
#include <vector>

#include "plate/bonds/family_operator.hpp"
#include "plate/formulation/boundary.hpp"
#include "plate/model/state.hpp"

namespace plate {

/// Every second point of a lattice in both directions, and how displacements of these give those of all points
/// (theory.md, "Statics"): bilinear between the points of the coarse lattice that a point is bonded to, so that nothing
/// goes across a crack; the deflection with what the rotations add to it in a plate without shear.
class Transfer {
public:
  Transfer(const geometry::Families& families, const Boundary& boundary);

  std::size_t coarse_points() const { return cell_.size(); }
  /// Place of a coarse point in the coarse lattice.
  struct Cell {
    std::int32_t column, row;
    auto operator<=>(const Cell&) const = default;
  };
  const std::vector<Cell>& cells() const { return cell_; }
  /// The point of the plate that each coarse one is.
  const std::vector<std::uint32_t>& fine_points() const { return fine_point_; }

  void prolong(const State& coarse, State& fine) const;       // adds to `fine`
  void restrict_to(State& coarse, const Forces& fine) const;  // the transpose: coarse = R fine

private:
  struct Share {
    std::uint32_t other;  // coarse point of a fine one; fine point of a coarse one
    float weight, x, y;   // x, y: weight times lever of theta_y (negative) and theta_x [length]
  };
  struct Shares {
    std::vector<std::size_t> first;
    std::vector<Share> shares;
  };
  static Shares transposed(const Shares& shares, std::size_t others);

  std::vector<Cell> cell_;
  std::vector<std::uint32_t> fine_point_;
  Shares fine_, coarse_;  // of every fine point, of every coarse point
};

}  // namespace plate
