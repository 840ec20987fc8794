#include <algorithm>
#include <cmath>

#include "geometry/cells/rows/whole_lattice.hpp"

namespace geometry {

/// Makes the cells of a box.
class CellsAt {
public:
  CellsAt(const WholeLattice& whole, const CellBox& box) : whole_(whole), box_(box) {
    for (const auto& triangle : whole.triangles_)
      if (std::ranges::any_of(triangle, [&](auto k) { return box.contains(cell_of(place(k))); }))
        triangles_.push_back(triangle);
    choose_points();
  }

  CellsPart cells() && {
    auto& cells = result_.cells;
    cells.units = whole_.units_, cells.names = whole_.names_;
    add_squares();
    for (const auto& [a, b, c] : triangles_) cells.triangles.push_back({local(a), local(b), local(c)});
    keep_corners();
    for (const auto& [from, to, edge] : whole_.borders_) {
      const auto from_here = here(from), to_here = here(to);
      if (from_here != none && to_here != none) cells.borders.push_back({from_here, to_here, edge});
    }
    return std::move(result_);
  }

private:
  static constexpr auto none = std::uint32_t(-1);

  /// Some points of a row, and where they are among those that may be corners.
  struct Stretch {
    long from, to, row;
    std::uint32_t number, local;
  };

  Point place(std::uint32_t k) const { return whole_.place(k); }

  /// All points that may be corners.
  void choose_points() {
    Cell low{box_.low[0] - 1, box_.low[1] - 1}, high{box_.high[0] + 1, box_.high[1] + 1};
    const auto take = [&](const auto& cell) {
      for (const auto k : cell)
        if (k >= whole_.points_.size()) others_.push_back(k);
    };
    for (const auto& triangle : triangles_) {
      take(triangle);
      for (const auto k : triangle)
        for (const Eigen::Index axis : {0, 1}) {
          low[std::size_t(axis)] = std::min(low[std::size_t(axis)], long(std::floor(place(k)[axis])));
          high[std::size_t(axis)] = std::max(high[std::size_t(axis)], long(std::floor(place(k)[axis])) + 1);
        }
    }
    for (const auto& [at, square] : whole_.parted_)
      if (has(at.second, at.first)) take(square);
    std::ranges::sort(others_);
    const auto again = std::ranges::unique(others_);
    others_.erase(again.begin(), again.end());
    for (long j = std::max(0L, low[1]); j < std::min(high[1], whole_.points_.rows()); ++j)
      for (const auto& run : whole_.points_.row(j)) {
        const long from = std::max(long(run.from), low[0]), to = std::min(long(run.to), high[0]);
        if (from >= to) continue;
        stretches_.push_back({from, to, j, run.number + std::uint32_t(from - run.from), of_lattice_});
        of_lattice_ += std::uint32_t(to - from);
      }
    used_.assign(of_lattice_ + others_.size(), none);
  }

  /// Has this square a corner in the box?
  bool has(long i, long j) const {
    return i + 1 >= box_.low[0] && i < box_.high[0] && j + 1 >= box_.low[1] && j < box_.high[1];
  }

  /// Among the points that may be corners; none: it may not.
  std::uint32_t local(std::uint32_t k) const {
    if (k >= whole_.points_.size()) {
      const auto found = std::ranges::lower_bound(others_, k);
      return found != others_.end() && *found == k ? of_lattice_ + std::uint32_t(found - others_.begin()) : none;
    }
    const auto after = std::ranges::upper_bound(stretches_, k, {}, &Stretch::number);
    if (after == stretches_.begin()) return none;
    const auto& [from, to, row, number, first] = *(after - 1);
    return k - number < std::uint32_t(to - from) ? first + (k - number) : none;
  }

  std::uint32_t local(long i, long j) const {
    const auto after = std::ranges::upper_bound(stretches_, std::pair(j, i), {},
                                                [](const Stretch& one) { return std::pair(one.row, one.from); });
    return (after - 1)->local + std::uint32_t(i - (after - 1)->from);
  }

  void add_squares() {
    auto& squares = result_.cells.squares;
    for (long j = std::max(0L, box_.low[1] - 1); j < std::min(box_.high[1], whole_.squares_.rows()); ++j)
      for (const auto& run : whole_.squares_.row(j)) {
        const long from = std::max(long(run.from), box_.low[0] - 1), to = std::min(long(run.to), box_.high[0]);
        if (from >= to) continue;
        const auto below = local(from, j), above = local(from, j + 1);
        for (std::uint32_t n = 0; n < std::uint32_t(to - from); ++n)
          squares.push_back({below + n, below + n + 1, above + n + 1, above + n});
        const auto first = squares.end() - (to - from);
        const auto& parted = whole_.parted_;
        for (auto at = std::ranges::lower_bound(parted, std::pair(j, from), {}, &WholeLattice::AtPlace::first);
             at != parted.end() && at->first < std::pair(j, to); ++at)
          std::ranges::transform(at->second, first[at->first.second - from].begin(), [&](auto k) { return local(k); });
      }
  }

  /// Of the points that may be corners those that are.
  void keep_corners() {
    auto& cells = result_.cells;
    const auto for_corners = [&](const auto& visit) {
      for (auto& square : cells.squares) std::ranges::for_each(square, visit);
      for (auto& triangle : cells.triangles) std::ranges::for_each(triangle, visit);
    };
    for_corners([&](std::uint32_t& k) { used_[k] = 0; });
    const auto count = std::size_t(std::ranges::count(used_, 0U));
    cells.positions.reserve(count), cells.local.reserve(count), result_.number.reserve(count);
    const auto add = [&](std::uint32_t at, std::uint32_t number, const Point& u) {
      if (used_[at] == none) return;
      used_[at] = std::uint32_t(result_.number.size());
      result_.number.push_back(number);
      cells.local.push_back(whole_.units_.spacing * u);
      cells.positions.push_back(whole_.units_.from_lattice(u));
    };
    for (const auto& [from, to, row, number, first] : stretches_)
      for (std::uint32_t n = 0; n < std::uint32_t(to - from); ++n)
        add(first + n, number + n, {double(from + n), double(row)});
    for (std::uint32_t n = 0; n < others_.size(); ++n) add(of_lattice_ + n, others_[n], place(others_[n]));
    for_corners([&](std::uint32_t& k) { k = used_[k]; });
  }

  std::uint32_t here(std::uint32_t k) const {
    const auto at = local(k);
    return at == none ? none : used_[at];
  }

  const WholeLattice& whole_;
  const CellBox& box_;
  std::vector<Tessellation::Triangle> triangles_;  // by numbers in the whole
  std::vector<Stretch> stretches_;
  std::uint32_t of_lattice_ = 0;
  std::vector<std::uint32_t> others_;  // numbers in the whole
  std::vector<std::uint32_t> used_;    // of the points that may be corners: number in the result, or none
  CellsPart result_;
};

CellsPart WholeLattice::cells_at(const CellBox& box) const {
  return CellsAt(*this, box).cells();
}

}  // namespace geometry
