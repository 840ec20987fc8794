#include "plate/solve/matrices/point_matrix.hpp"

#include <algorithm>
#include <numeric>

namespace plate {
namespace {

/// The blocks that one unknown point after the other has: which block of the matrix, and whether it is transposed.
struct Placed {
  std::uint32_t row;  // among the points with unknowns
  std::uint32_t transposed;
  std::size_t block;
};

/// Points with unknowns, in the order of those, and of every point its place among them.
struct Places {
  static constexpr auto none = std::uint32_t(-1);
  std::vector<std::uint32_t> point, place;

  Places(const Unknowns& unknowns, std::size_t points) : place(points, none) {
    for (const auto dof : unknowns.dof)
      if (place[dof / 3] == none) place[dof / 3] = std::uint32_t(point.size()), point.push_back(dof / 3);
  }
};

/// Offsets from counts, which stand one to the right.
void accumulate(std::vector<std::size_t>& first) {
  std::partial_sum(first.begin(), first.end(), first.begin());
}

/// Columns in the order of the places, rows ascending; `first`: where they begin.
std::vector<Placed> placed(const PointMatrix& matrix, const Places& places, std::vector<std::size_t>& first) {
  struct Entry {
    std::uint32_t column, transposed;
    std::size_t block;
  };
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t k = 0; k < matrix.points(); ++k) {
      const auto column = places.place[k];
      if (column == Places::none) continue;
      for (auto b = matrix.first[k]; b < matrix.first[k + 1]; ++b)
        if (const auto row = places.place[matrix.row[b]]; row != Places::none)
          visit(std::max(row, column), Entry{std::min(row, column), row < column, b});
    }
  };
  // sorted by rows, then by columns
  std::vector<std::size_t> by_row(places.point.size() + 1, 0);
  first.assign(places.point.size() + 1, 0);
  for_each([&](std::uint32_t row, const Entry& entry) { ++by_row[row + 1], ++first[entry.column + 1]; });
  accumulate(by_row), accumulate(first);
  std::vector<Entry> entries(by_row.back());
  auto next = by_row;
  for_each([&](std::uint32_t row, const Entry& entry) { entries[next[row]++] = entry; });
  std::vector<Placed> result(entries.size());
  next = first;
  for (std::uint32_t row = 0; row < places.point.size(); ++row)
    for (auto e = by_row[row]; e < by_row[row + 1]; ++e)
      result[next[entries[e].column]++] = {row, entries[e].transposed, entries[e].block};
  return result;
}

}  // namespace

Unknowns unknowns(const Forces& diagonal, const std::vector<int>& order) {
  Unknowns result;
  const auto points = std::size_t(diagonal.cols());
  result.index.assign(3 * points, -1);
  for (std::size_t i = 0; i < (order.empty() ? points : order.size()); ++i) {
    const auto k = order.empty() ? i : std::size_t(order[i]);
    for (auto dof = 3 * k; dof < 3 * k + 3; ++dof) {
      if (!(at_dof(diagonal, dof) > 0)) continue;
      result.index[dof] = std::int32_t(result.dof.size());
      result.dof.push_back(std::uint32_t(dof));
    }
  }
  return result;
}

Eigen::SparseMatrix<double> of_unknowns(const PointMatrix& matrix, const Unknowns& unknowns) {
  const Places places(unknowns, matrix.points());
  std::vector<std::size_t> first;
  const auto blocks = placed(matrix, places, first);
  const auto count_of = [&](std::uint32_t place) {
    const auto dof = unknowns.index.begin() + 3 * std::ptrdiff_t(places.point[place]);
    return std::size_t(std::count_if(dof, dof + 3, [](auto index) { return index >= 0; }));
  };
  const auto size = unknowns.size();
  Eigen::SparseMatrix<double> result(size, size);
  std::size_t entries = 0;
  for (std::uint32_t c = 0, u = 0; c < places.point.size(); ++c) {
    std::size_t below = 0;
    for (auto b = first[c] + 1; b < first[c + 1]; ++b) below += count_of(blocks[b].row);
    for (auto own = count_of(c); own > 0; --own) result.outerIndexPtr()[u++] = int(entries), entries += own + below;
  }
  result.outerIndexPtr()[size] = int(entries);
  result.resizeNonZeros(Eigen::Index(entries));
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < places.point.size(); ++c)
    for (std::size_t d = 0; d < 3; ++d) {
      const auto u = unknowns.index[3 * places.point[c] + d];
      if (u < 0) continue;
      auto at = result.outerIndexPtr()[u];
      for (auto b = first[c]; b < first[c + 1]; ++b) {
        const auto& K = matrix.block[blocks[b].block];
        for (std::size_t r = 0; r < 3; ++r) {
          const auto v = unknowns.index[3 * places.point[blocks[b].row] + r];
          if (v < u) continue;  // none, or above the diagonal
          result.innerIndexPtr()[at] = v;
          const auto row = Eigen::Index(r), column = Eigen::Index(d);
          result.valuePtr()[at++] = blocks[b].transposed ? K(column, row) : K(row, column);
        }
      }
    }
  return result;
}

}  // namespace plate
