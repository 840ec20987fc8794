#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "plate/formulation/boundary.hpp"
#include "plate/model/section.hpp"

namespace plate {

/// Numbers 0 ... size - 1 in sets that only grow together. The root of a set is its smallest number.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

private:
  std::vector<std::uint32_t> parent_;
};

/// The number of the set of every point: its root; where the plate is distributed, the same in all of them for sets
/// that are one through points that several see. All processes call it at once.
std::vector<std::int64_t> set_numbers(DisjointSets& sets, const Boundary& boundary);

/// A part of the plate that no bond connects to the rest.
struct Piece {
  std::size_t points = 0;
  geometry::Point position{0, 0};  // of its first point [length]
  std::uint32_t first_point = 0;
  int free_modes = 0;  // of its three rigid motions, how many no support prevents
};

/// Pieces of the plate, largest first. Bonds, mirror images and ties connect.
std::vector<Piece> pieces(const Boundary& boundary, const geometry::Families& families,
                          PlateLaw law = PlateLaw::bending);

/// Points of detached pieces: of all pieces that no support holds in any way; of a plate that is not held at all,
/// all but the largest.
std::vector<std::uint32_t> detached_points(const Boundary& boundary, const geometry::Families& families);

}  // namespace plate
