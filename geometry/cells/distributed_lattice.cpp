#include "geometry/cells/distributed_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geometry {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Values in order, each with the number of points that have it.
template <typename Value>
using Counted = std::vector<std::pair<Value, std::size_t>>;

/// Finds the value at which to split so that the number of points below it is nearest to `wanted`. Returns that number
/// and the index of the value, never the first.
template <typename Value>
std::optional<std::pair<std::size_t, std::size_t>> nearest_cut(const Counted<Value>& counts, std::size_t wanted) {
  const auto off = [&](std::size_t cut) { return std::abs(double(cut) - double(wanted)); };
  std::optional<std::pair<std::size_t, std::size_t>> result;
  std::size_t before = counts.front().second;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    if (!result || off(before) < off(result->first)) result.emplace(before, i);
    before += counts[i].second;
  }
  return result;
}

}  // namespace

struct DistributedLattice::Box {
  long from = 0, to = 0;                    // column blocks
  double low = -infinite, high = infinite;  // y

  bool has(double y) const { return y >= low && y < high; }
};

struct DistributedLattice::Count {
  std::size_t points = 0;
  Point low{infinite, infinite}, high{-infinite, -infinite};
  Counted<long> column_blocks;
  Counted<double> rows;

  void reach(const Point& x) { low = low.cwiseMin(x), high = high.cwiseMax(x); }
};

DistributedLattice::DistributedLattice(const GlobalLattice& global, int parts)
    : global_(global), parts_(std::size_t(parts)) {
  begin_ = share_out({0, (global.last()[0] + 2) / columns_per_block + 1}, 0, parts);
}

/// Calls visit(run of columns, the number of its first point, row).
template <typename Visit>
void DistributedLattice::for_runs(const Box& box, const Visit& visit) const {
  const auto& points = global_.points();
  for (long j = 0; j < points.rows(); ++j) {
    if (!box.has(global_.units().from_lattice({0, double(j)}).y())) continue;
    for (const auto& run : points.row(j)) {
      const long from = std::max(long(run.from), box.from * columns_per_block),
                 to = std::min(long(run.to), box.to * columns_per_block);
      if (from < to) visit(Columns{from, to}, run.number + std::uint32_t(from - run.from), j);
    }
  }
}

/// Calls visit(place [spacings], number, column block).
template <typename Visit>
void DistributedLattice::for_others(const Box& box, const Visit& visit) const {
  const auto& units = global_.units();
  for (std::uint32_t n = 0; n < global_.others().size(); ++n) {
    const Point& u = global_.others()[n];
    const long in = column_block_at(units.spacing * u.x(), units.spacing);
    if (in >= box.from && in < box.to && box.has(units.from_lattice(u).y())) visit(u, global_.points().size() + n, in);
  }
}

DistributedLattice::Count DistributedLattice::counted(const Box& box) const {
  Count result;
  const auto& units = global_.units();
  for (long in = box.from; in < box.to; ++in) result.column_blocks.emplace_back(in, 0);
  const auto in_column_block = [&](long in) -> std::size_t& {
    return result.column_blocks[std::size_t(in - box.from)].second;
  };
  for_runs(box, [&](const Columns& columns, std::uint32_t, long j) {
    const auto& [from, to] = columns;
    for (long in = from / columns_per_block; in * columns_per_block < to; ++in)
      in_column_block(in) +=
          std::size_t(std::min(to, (in + 1) * columns_per_block) - std::max(from, in * columns_per_block));
    result.reach(units.from_lattice({double(from), double(j)}));
    result.reach(units.from_lattice({double(to - 1), double(j)}));
    result.rows.emplace_back(units.from_lattice({0, double(j)}).y(), std::size_t(to - from));
  });
  for_others(box, [&](const Point& u, std::uint32_t, long in) {
    const Point x = units.from_lattice(u);
    ++in_column_block(in);
    result.reach(x);
    result.rows.emplace_back(x.y(), 1);
  });
  std::ranges::sort(result.rows);
  Counted<double> once;
  for (const auto& [y, count] : result.rows) {
    if (once.empty() || once.back().first != y) once.emplace_back(y, 0);
    once.back().second += count, result.points += count;
  }
  result.rows = std::move(once);
  std::erase_if(result.column_blocks, [](const auto& one) { return one.second == 0; });
  return result;
}

/// Splits a box as shared_out() does; nothing where all points are of one row, which has no place for a split.
std::optional<DistributedLattice::Cut> DistributedLattice::halved(const Count& count, double share) {
  constexpr double of_rows = 1.5, most = 0.1;
  const auto wanted = std::size_t(double(count.points) * share + 0.5);
  const Point size = count.high - count.low;
  if (size.x() > of_rows * size.y())
    if (const auto cut = nearest_cut(count.column_blocks, wanted);
        cut && std::abs(double(cut->first) - double(wanted)) <= most * double(count.points))
      return Cut{0, count.column_blocks[cut->second].first, 0};
  const auto cut = nearest_cut(count.rows, wanted);
  if (!cut) return std::nullopt;
  const double before = count.rows[cut->second - 1].first, y = count.rows[cut->second].first;
  const double middle = before + (y - before) / 2;  // nobody's y
  return Cut{1, 0, middle > before ? middle : y};
}

int DistributedLattice::share_out(const Box& box, int first, int parts) {
  const auto count = counted(box);
  if (parts == 1 || count.points == 0) {
    if (count.points > 0) parts_[std::size_t(first)] = {count.points, count.low, count.high};
    return -1 - first;
  }
  const int lower = parts / 2;
  const auto cut = halved(count, double(lower) / parts);
  if (!cut) return share_row(box, first, parts);
  const auto at = cuts_.size();
  cuts_.push_back(*cut);
  auto below = box, above = box;
  if (cut->axis == 0)
    below.to = above.from = cut->column_block;
  else
    below.high = above.low = cut->y;
  const int of_lower = share_out(below, first, lower), of_upper = share_out(above, first + lower, parts - lower);
  cuts_[at].lower = of_lower, cuts_[at].upper = of_upper;
  return int(at);
}

/// Distributes a row by its points, as it is no longer than the plate is wide.
int DistributedLattice::share_row(const Box& box, int first, int parts) {
  CellsPart row;
  auto& cells = row.cells;
  cells.units = global_.units();
  const auto add = [&](const Point& u, std::uint32_t number) {
    cells.positions.push_back(cells.units.from_lattice(u)), cells.local.push_back(cells.units.spacing * u);
    row.number.push_back(number);
  };
  for_runs(box, [&](const Columns& columns, std::uint32_t number, long j) {
    for (long i = columns.first; i < columns.second; ++i) add({double(i), double(j)}, number++);
  });
  for_others(box, [&](const Point& u, std::uint32_t number, long) { add(u, number); });
  const auto owners = shared_out(cells, parts);
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const auto& x = cells.positions[k];
    const int owner = first + owners[k];
    single_[row.number[k]] = owner;
    auto& part = parts_[std::size_t(owner)];
    part = part.points == 0 ? Part{1, x, x} : Part{part.points + 1, part.low.cwiseMin(x), part.high.cwiseMax(x)};
  }
  return by_points;
}

std::vector<int> DistributedLattice::owners(const CellsPart& some) const {
  std::vector<int> result;
  result.reserve(some.number.size());
  for (std::size_t k = 0; k < some.number.size(); ++k) {
    int at = begin_;
    while (at >= 0) {
      const auto& cut = cuts_[std::size_t(at)];
      const bool above =
          cut.axis == 0 ? column_block_of(some.cells, k) >= cut.column_block : some.cells.positions[k].y() >= cut.y;
      at = above ? cut.upper : cut.lower;
    }
    result.push_back(at == by_points ? single_.at(some.number[k]) : -1 - at);
  }
  return result;
}

}  // namespace geometry
