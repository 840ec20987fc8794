#pragma once
#include "plate/formulation/boundary.hpp"

namespace plate {

/// A part of the plate that no bond connects to the rest.
struct Piece {
  std::size_t points = 0;
  geometry::Point position{0, 0};  // of its first point [length]
  std::uint32_t first_point = 0;
  int free_modes = 0;  // of its three rigid motions, how many no support prevents
};

/// All pieces, largest first. Bonds, mirror images and ties connect.
std::vector<Piece> pieces(const Boundary& boundary, const geometry::Families& families);

/// The points that have fallen off: of all pieces that no support holds in any way; of a plate that is not held at all,
/// all but the largest.
std::vector<std::uint32_t> fallen(const Boundary& boundary, const geometry::Families& families);

}  // namespace plate
