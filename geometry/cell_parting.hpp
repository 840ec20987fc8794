#pragma once
#include <utility>
#include "geometry/tessellation.hpp"

namespace geometry {

/// What changes where cells are parted along one side.
struct Parting {
  std::vector<std::uint32_t> origins;  // of the new points, the last ones: at the same places
  std::vector<std::uint32_t> touched;  // points whose cells have other corners now, new ones among them, ascending
};

/// Parts the cells of a plate along their sides, one after the other: how a crack grows.
class CellParting {
public:
  /// `cells` must outlive this, and be changed by nothing else.
  explicit CellParting(Tessellation& cells);

  /// Parts the two cells at the side between two points. Points about which cells no longer hang together get a point
  /// for each part: the tip that was there, not the tip that is there now. Throws std::invalid_argument where the
  /// points share no side, or only one cell has it.
  Parting part(std::uint32_t tip, std::uint32_t next);

  /// The cells about a point: squares, then triangles.
  const std::vector<std::uint32_t>& cells_at(std::uint32_t k) const { return about_[k]; }
  std::size_t corners(std::uint32_t cell) const { return cell < cells_.squares.size() ? 4 : 3; }
  std::uint32_t corner(std::uint32_t cell, std::size_t c) const { return data(cell)[c]; }

private:
  const std::uint32_t* data(std::uint32_t cell) const;
  std::uint32_t* data(std::uint32_t cell) { return const_cast<std::uint32_t*>(std::as_const(*this).data(cell)); }
  /// The corner after k (`forward`) or before it.
  std::uint32_t beside(std::uint32_t cell, std::uint32_t k, bool forward) const;
  void part_point(std::uint32_t k, std::uint32_t other, Parting& result);

  Tessellation& cells_;
  std::vector<std::vector<std::uint32_t>> about_;
};

}  // namespace geometry
