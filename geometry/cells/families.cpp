#include <algorithm>
#include <limits>

#include "geometry/cells/tessellation.hpp"

namespace geometry {
namespace {

/// Calls visit(corners, count) for every cell.
template <typename Visit>
void for_cells(const Tessellation& cells, const Visit& visit) {
  for (const auto& square : cells.squares) visit(square.data(), std::size_t(4));
  for (const auto& triangle : cells.triangles) visit(triangle.data(), std::size_t(3));
}

/// The other corners of the cells about every point.
class Members {
public:
  explicit Members(const Tessellation& cells) : first_(cells.local.size() + 1, 0) {
    for_cells(cells, [&](const std::uint32_t* corner, std::size_t count) {
      for (std::size_t c = 0; c < count; ++c) first_[corner[c] + 1] += count - 1;
    });
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    member_.resize(first_.back());
    auto next = first_;
    for_cells(cells, [&](const std::uint32_t* corner, std::size_t count) {
      for (std::size_t c = 0; c < count; ++c)
        for (std::size_t other = 1; other < count; ++other) member_[next[corner[c]]++] = corner[(c + other) % count];
    });
  }

  /// Ascending, each once.
  void list(std::uint32_t k, std::vector<std::uint32_t>& found) const {
    found.assign(member_.begin() + std::ptrdiff_t(first_[k]), member_.begin() + std::ptrdiff_t(first_[k + 1]));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> member_;
};

}  // namespace

Families cell_families(const Tessellation& cells) {
  if (cells.squares.empty()) return exact_cell_families(cells);
  const Members members(cells);
  return families(cells.units.spacing, cells.local,
                  [&](std::uint32_t k, std::vector<std::uint32_t>& found) { members.list(k, found); });
}

Families exact_cell_families(const Tessellation& cells) {
  const Members members(cells);
  std::vector<Point> vectors;
  std::vector<std::uint32_t> pattern, found;
  std::vector<std::size_t> first{0};
  std::vector<Families::Step> steps;
  for (std::uint32_t k = 0; k < cells.local.size(); ++k) {
    members.list(k, found);
    for (const auto j : found) {
      steps.push_back({std::int32_t(j - k), std::uint32_t(vectors.size())});
      vectors.push_back(cells.local[j] - cells.local[k]);
    }
    pattern.push_back(k);
    first.push_back(steps.size());
  }
  return {std::move(vectors), std::move(pattern), std::move(first), std::move(steps)};
}

std::vector<Point> seen_positions(const Tessellation& cells) {
  constexpr double step = 2e-6;
  std::vector<Point> inwards(cells.local.size(), Point(0, 0)), result = cells.positions;
  std::vector<double> near(result.size(), std::numeric_limits<double>::infinity());
  for (const auto& border : cells.borders) {
    if (border.edge != Curves::crack) continue;
    const Point along = cells.local[border.to] - cells.local[border.from];
    for (const auto k : {border.from, border.to}) {
      inwards[k] += Point(-along.y(), along.x()).normalized();
      near[k] = std::min(near[k], along.norm());
    }
  }
  for (std::size_t k = 0; k < result.size(); ++k)
    if (inwards[k].norm() > 1e-6) result[k] += step * near[k] * inwards[k].normalized();
  return result;
}

}  // namespace geometry
