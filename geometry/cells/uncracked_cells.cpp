#include "geometry/cells/uncracked_cells.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace geometry {
namespace {

/// Returns the key of the side between two corners, equal for both directions.
std::uint64_t side_between(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

struct Corner {
  std::uint32_t* point;         // in its cell
  std::uint32_t before, after;  // the corners next to it
  std::size_t part = 0;
};

/// Cells about a point that share a side which is no crack belong together: numbers their parts.
std::size_t parts(std::vector<Corner>& corners, std::uint32_t k,
                  const std::unordered_map<std::uint64_t, std::int32_t>& cracks) {
  std::size_t count = 0;
  std::vector<char> known(corners.size(), 0);
  for (std::size_t first = 0; first < corners.size(); ++first) {
    if (known[first]) continue;
    std::vector<std::size_t> open{first};
    known[first] = 1;
    while (!open.empty()) {
      auto& corner = corners[open.back()];
      open.pop_back();
      corner.part = count;
      for (std::size_t other = 0; other < corners.size(); ++other)
        for (const auto neighbour : {corner.before, corner.after})
          if (!known[other] && (corners[other].before == neighbour || corners[other].after == neighbour) &&
              !cracks.contains(side_between(k, neighbour)))
            known[other] = 1, open.push_back(other);
    }
    ++count;
  }
  return count;
}

/// Gives every part of the cells about a point on a curve its own point, new points last; returns for every point the
/// one that it comes from.
std::vector<std::uint32_t> part_cells(Cells& cells) {
  std::unordered_map<std::uint64_t, std::int32_t> cracks;
  std::map<std::uint32_t, std::vector<Corner>> on_curves;
  for (const auto& piece : cells.pieces) {
    if (piece.edge == Curves::crack) cracks[side_between(piece.from, piece.to)] = piece.edge;
    on_curves[piece.from], on_curves[piece.to];
  }
  std::vector<std::uint32_t> origin(cells.positions.size());
  std::iota(origin.begin(), origin.end(), 0);
  std::vector<char> curved(cells.positions.size(), 0);
  for (const auto& [k, corners] : on_curves) curved[k] = 1;
  for_cells(cells, [&](const auto& corners) {
    const auto count = corners.size();
    for (std::size_t c = 0; c < count; ++c)
      if (curved[corners[c]])
        on_curves[corners[c]].push_back({&corners[c], corners[(c + count - 1) % count], corners[(c + 1) % count]});
  });
  for (auto& [k, corners] : on_curves) {
    const auto count = parts(corners, k, cracks);
    for (std::size_t part = 1; part < count; ++part) {
      for (auto& corner : corners)
        if (corner.part == part) *corner.point = std::uint32_t(cells.positions.size());
      cells.positions.push_back(cells.positions[k]);
      origin.push_back(k);
    }
  }
  return origin;
}

/// Leaves out points without cells.
void compact(Cells& cells, std::vector<std::uint32_t>& origin) {
  constexpr auto unused = std::uint32_t(-1);
  std::vector<std::uint32_t> index(cells.positions.size(), unused);
  for_corners(cells, [&](std::uint32_t k) { index[k] = 0; });
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < index.size(); ++k)
    if (index[k] != unused) {
      cells.positions[next] = cells.positions[k], origin[next] = origin[k];
      index[k] = next++;
    }
  cells.positions.resize(next), origin.resize(next);
  for_corners(cells, [&](std::uint32_t& k) { k = index[k]; });
}

}  // namespace

std::vector<std::uint32_t> part(Cells& cells) {
  auto origin = part_cells(cells);
  compact(cells, origin);
  return origin;
}

std::vector<Tessellation::Border> borders(const Cells& cells, const std::vector<std::uint32_t>& origin) {
  std::unordered_map<std::uint64_t, std::int32_t> edge_of;
  std::vector<char> curved(*std::max_element(origin.begin(), origin.end()) + 1, 0);
  for (const auto& piece : cells.pieces) {
    edge_of[side_between(piece.from, piece.to)] = piece.edge;
    curved.at(piece.from) = curved.at(piece.to) = 1;
  }
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> open;
  std::vector<std::uint64_t> order;
  for_cells(cells, [&](const auto& corners) {
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const auto from = corners[c], to = corners[(c + 1) % corners.size()];
      if (!curved[origin[from]] || !curved[origin[to]]) continue;
      if (open.erase(side_between(from, to)) == 0)
        open[side_between(from, to)] = {from, to}, order.push_back(side_between(from, to));
    }
  });
  std::vector<Tessellation::Border> result;
  for (const auto key : order)
    if (const auto found = open.find(key); found != open.end()) {
      const auto [from, to] = found->second;
      const auto edge = edge_of.find(side_between(origin[from], origin[to]));
      if (edge == edge_of.end()) throw std::logic_error("a cell has a side that is neither shared nor on a curve");
      result.push_back({from, to, edge->second});
      open.erase(found);
    }
  return result;
}

}  // namespace geometry
