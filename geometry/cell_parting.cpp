#include "geometry/cell_parting.hpp"

#include <algorithm>
#include <stdexcept>

namespace geometry {

CellParting::CellParting(Tessellation& cells) : cells_(cells), about_(cells.positions.size()) {
  const auto count = std::uint32_t(cells.squares.size() + cells.triangles.size());
  for (std::uint32_t cell = 0; cell < count; ++cell)
    for (std::size_t c = 0; c < corners(cell); ++c) about_[corner(cell, c)].push_back(cell);
}

const std::uint32_t* CellParting::data(std::uint32_t cell) const {
  const auto squares = cells_.squares.size();
  return cell < squares ? cells_.squares[cell].data() : cells_.triangles[cell - squares].data();
}

std::uint32_t CellParting::beside(std::uint32_t cell, std::uint32_t k, bool forward) const {
  const auto count = corners(cell);
  for (std::size_t c = 0; c < count; ++c)
    if (corner(cell, c) == k) return corner(cell, (c + (forward ? 1 : count - 1)) % count);
  throw std::logic_error("a cell is not about its corner");
}

/// Cells about k hang together by the sides that they share, but for the one between k and `other`.
void CellParting::part_point(std::uint32_t k, std::uint32_t other, Parting& result) {
  auto rest = about_[k];
  bool first = true;
  while (!rest.empty()) {
    std::vector<std::uint32_t> part{rest.back()};
    rest.pop_back();
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const bool forward : {false, true}) {
        const auto neighbour = beside(part[i], k, forward);
        if (neighbour == other) continue;
        const auto found =
            std::find_if(rest.begin(), rest.end(), [&](auto cell) { return beside(cell, k, !forward) == neighbour; });
        if (found != rest.end()) part.push_back(*found), rest.erase(found);
      }
    if (first) {
      first = false;
      about_[k] = part;
      continue;
    }
    const auto fresh = std::uint32_t(cells_.positions.size());
    const Point place = cells_.positions[k], local = cells_.local[k];
    cells_.positions.push_back(place), cells_.local.push_back(local);
    result.origins.push_back(k);
    for (const auto cell : part) std::replace(data(cell), data(cell) + corners(cell), k, fresh);
    for (auto& border : cells_.borders) {  // a border belongs to the cell on its left
      const auto of_part = [&](std::uint32_t a, std::uint32_t b, std::uint32_t at) {
        return std::any_of(part.begin(), part.end(), [&](auto cell) {
          return at == a ? beside(cell, fresh, true) == b : beside(cell, fresh, false) == a;
        });
      };
      if (border.from == k && of_part(k, border.to, k)) border.from = fresh;
      if (border.to == k && of_part(border.from, k, k)) border.to = fresh;
    }
    about_.push_back(std::move(part));
  }
}

Parting CellParting::part(std::uint32_t tip, std::uint32_t next) {
  const auto has_side = [&](bool forward) {
    return std::find_if(about_[tip].begin(), about_[tip].end(),
                        [&](auto cell) { return beside(cell, tip, forward) == next; });
  };
  const auto left = has_side(true), right = has_side(false);
  if (left == about_[tip].end() || right == about_[tip].end())
    throw std::invalid_argument("the points do not share a side of two cells");
  const auto left_cell = *left, right_cell = *right;
  Parting result;
  for (const auto k : {tip, next})
    for (const auto cell : about_[k])
      for (std::size_t c = 0; c < corners(cell); ++c) result.touched.push_back(corner(cell, c));
  // both ends are looked at while they still have the points that they had
  const auto old_points = cells_.positions.size();
  part_point(tip, next, result);
  const auto tip_of = [&](std::uint32_t cell, bool forward) {  // the point that the cell has at the tip's place
    for (std::size_t c = 0; c < corners(cell); ++c)
      if (corner(cell, c) == next) return beside(cell, next, !forward);
    throw std::logic_error("a cell lost its corner");
  };
  const auto left_tip = tip_of(left_cell, true), right_tip = tip_of(right_cell, false);
  if (left_tip == right_tip) {
    part_point(next, tip, result);
  } else {
    // the side is parted at the tip already: cells about `next` that do not share its other end do not share it
    part_point(next, std::uint32_t(-1), result);
  }
  const auto end_of = [&](std::uint32_t cell, std::uint32_t at_tip, bool forward) {
    return beside(cell, at_tip, forward);
  };
  cells_.borders.push_back({left_tip, end_of(left_cell, left_tip, true), Curves::crack});
  cells_.borders.push_back({end_of(right_cell, right_tip, false), right_tip, Curves::crack});
  for (auto k = old_points; k < cells_.positions.size(); ++k) result.touched.push_back(std::uint32_t(k));
  std::sort(result.touched.begin(), result.touched.end());
  result.touched.erase(std::unique(result.touched.begin(), result.touched.end()), result.touched.end());
  return result;
}

}  // namespace geometry
