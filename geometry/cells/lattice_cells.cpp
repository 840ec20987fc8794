#include "geometry/cells/lattice_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "geometry/cells/triangulation.hpp"
#include "geometry/shape/predicates.hpp"

namespace geometry {

std::vector<Columns> common(const std::vector<Columns>& one, const std::vector<Columns>& other) {
  std::vector<Columns> result;
  for (std::size_t a = 0, b = 0; a < one.size() && b < other.size();) {
    const Columns both{std::max(one[a].first, other[b].first), std::min(one[a].second, other[b].second)};
    if (both.first < both.second) result.push_back(both);
    one[a].second < other[b].second ? ++a : ++b;
  }
  return result;
}

std::vector<Columns> joined(const std::vector<Columns>& one, const std::vector<Columns>& other) {
  std::vector<Columns> all(one.size() + other.size()), result;
  std::ranges::merge(one, other, all.begin());
  for (const auto& next : all)
    if (!result.empty() && next.first <= result.back().second)
      result.back().second = std::max(result.back().second, next.second);
    else
      result.push_back(next);
  return result;
}

std::vector<Columns> without(const std::vector<Columns>& one, const std::vector<Columns>& other) {
  std::vector<Columns> result;
  std::size_t b = 0;
  for (auto [from, to] : one) {
    while (b < other.size() && other[b].second <= from) ++b;
    for (auto next = b; next < other.size() && other[next].first < to; ++next) {
      if (from < other[next].first) result.emplace_back(from, other[next].first);
      from = std::max(from, other[next].second);
    }
    if (from < to) result.emplace_back(from, to);
  }
  return result;
}

void RowRuns::add(const Columns& columns) {
  if (columns.first >= columns.second) return;
  if (columns.second - columns.first > long(std::numeric_limits<std::uint32_t>::max() - size_))
    throw std::length_error("a lattice of more than 4294967295 points: their numbers have 32 bits");
  if (runs_.size() > first_.back() && runs_.back().to == columns.first)
    runs_.back().to = std::int32_t(columns.second);
  else
    runs_.push_back({std::int32_t(columns.first), std::int32_t(columns.second), size_});
  size_ += std::uint32_t(columns.second - columns.first);
}

std::span<const RowRuns::Run> RowRuns::row(long j) const {
  if (j < 0 || j >= rows()) return {};
  const auto begin = first_[std::size_t(j)], end = j + 1 < rows() ? first_[std::size_t(j) + 1] : runs_.size();
  return std::span(runs_).subspan(begin, end - begin);
}

std::vector<Columns> RowRuns::columns(long j) const {
  std::vector<Columns> result;
  for (const auto& run : row(j)) result.emplace_back(run.from, run.to);
  return result;
}

const RowRuns::Run* RowRuns::run_at(long i, long j) const {
  const auto runs = row(j);
  const auto after = std::ranges::upper_bound(runs, i, {}, [](const Run& run) { return long(run.from); });
  if (after == runs.begin() || (after - 1)->to <= i) return nullptr;
  return &*(after - 1);
}

std::optional<std::uint32_t> RowRuns::at(long i, long j) const {
  const auto* run = run_at(i, j);
  return run ? std::optional(std::uint32_t(run->number + (i - run->from))) : std::nullopt;
}

std::pair<long, long> RowRuns::place(std::uint32_t number) const {
  const auto run = std::ranges::upper_bound(runs_, number, {}, &Run::number) - 1;
  const auto row = std::ranges::upper_bound(first_, std::size_t(run - runs_.begin())) - 1;
  return {run->from + long(number - run->number), long(row - first_.begin())};
}

RowRuns RowRuns::except(std::span<const std::uint32_t> numbers) const {
  RowRuns result;
  auto next = numbers.begin();
  for (long j = 0; j < rows(); ++j) {
    result.begin_row();
    for (const auto& run : row(j)) {
      long from = run.from;
      const auto end = run.number + std::uint32_t(run.to - run.from);
      for (; next != numbers.end() && *next < end; ++next) {
        const long gone = run.from + long(*next - run.number);
        result.add({from, gone});
        from = gone + 1;
      }
      result.add({from, run.to});
    }
  }
  return result;
}

namespace {

/// True where the segment passes through the open square from `low` to low + (1, 1).
bool enters_square(const Point& a, const Point& b, const Point& low) {
  double first = 0, last = 1;
  for (const int axis : {0, 1}) {
    const double d = b[axis] - a[axis], from = low[axis] - a[axis], to = from + 1;
    if (d == 0) {
      if (from >= 0 || to <= 0) return false;
      continue;
    }
    first = std::max(first, std::min(from / d, to / d));
    last = std::min(last, std::max(from / d, to / d));
  }
  return last - first > 1e-9;
}

/// Calls visit(i, j) for all in the box about a segment.
template <typename Visit>
void about(const Point& a, const Point& b, double margin, long last_i, long last_j, const Visit& visit) {
  const auto low = [margin](double x, double y) { return std::max(0L, long(std::ceil(std::min(x, y) - margin))); };
  const auto high = [margin](double x, double y) { return long(std::floor(std::max(x, y) + margin)); };
  for (long j = low(a.y(), b.y()); j <= std::min(high(a.y(), b.y()), last_j); ++j)
    for (long i = low(a.x(), b.x()); i <= std::min(high(a.x(), b.x()), last_i); ++i) visit(i, j);
}

std::pair<long, long> key(const NearCurves::Mark& mark) {
  return {mark.row, mark.column};
}

}  // namespace

NearCurves::NearCurves(const Curves& curves, double clearance, long columns, long rows) {
  const auto mark = [&](const Point& a, const Point& b, bool is_edge) {
    about(a, b, 1.5, columns, rows, [&](long i, long j) {
      const bool left_out = distance_to_segment(a, b, Point(double(i), double(j))) < clearance;
      if (left_out || is_edge) marks_.push_back({std::int32_t(j), std::int32_t(i), left_out});
    });
  };
  for (const auto& x : curves.nodes) mark(x, x, false);
  for (const auto& piece : curves.pieces) {
    const Point &a = curves.nodes[piece.from], &b = curves.nodes[piece.to];
    mark(a, b, piece.edge != Curves::crack);
    about(a, b, 1, columns - 1, rows - 1, [&](long i, long j) {
      if (enters_square(a, b, {double(i), double(j)})) blocked_.emplace_back(j, i);
    });
  }
  for (const auto& x : curves.nodes)
    if (x.x() != std::round(x.x()) || x.y() != std::round(x.y()))
      about(x, x, 1, columns - 1, rows - 1, [&](long i, long j) {
        if (x.x() >= double(i) && x.y() >= double(j)) blocked_.emplace_back(j, i);
      });
  std::ranges::sort(marks_, {}, [](const Mark& one) { return std::tuple(one.row, one.column, !one.left_out); });
  const auto again = std::ranges::unique(marks_, {}, key);  // of several the first, which leaves out where any does
  marks_.erase(again.begin(), again.end());
  keep_once(blocked_);
}

std::span<const NearCurves::Mark> NearCurves::row(long j) const {
  return std::ranges::equal_range(marks_, j, {}, &Mark::row);
}

bool NearCurves::near(long i, long j) const {
  return std::ranges::binary_search(marks_, std::pair(j, i), {}, key);
}

std::vector<long> NearCurves::blocked(long j) const {
  std::vector<long> result;
  for (const auto& [row, column] : std::ranges::equal_range(blocked_, j, {}, &std::pair<long, long>::first))
    result.push_back(column);
  return result;
}

namespace {

using Side = std::pair<std::uint32_t, std::uint32_t>;

Side sides(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

bool on_lattice(const Point& x) {
  return x.x() == std::round(x.x()) && x.y() == std::round(x.y());
}

class Builder {
public:
  Builder(const Curves& curves, double clearance)
      : curves_(curves),
        columns_(long(std::ceil(bounding_box(curves.outline).second.x()))),
        rows_(long(std::ceil(bounding_box(curves.outline).second.y()))),
        near_(curves, clearance, columns_, rows_),
        node_(curves.nodes.size(), 0) {}

  LatticeCells cells() {
    number_points();
    for (long j = 0; j < rows_; ++j) find_squares(j);
    for (const auto& piece : curves_.pieces) {
      result_.pieces.push_back({node_[piece.from], node_[piece.to], piece.edge});
      edge_of_[sides(node_[piece.from], node_[piece.to])] = piece.edge;
    }
    fill_the_rest();
    return std::move(result_);
  }

private:
  bool is_square(long i, long j) const { return result_.squares.run_at(i, j) != nullptr; }
  bool in_outline(double x, double y) const { return contains(curves_.outline, {x, y}); }

  /// Lattice points row by row, nodes among them; the other nodes after these.
  void number_points() {
    std::map<std::pair<long, long>, std::uint32_t> at;  // nodes on lattice points, by row and column
    std::vector<std::uint32_t> others;
    for (std::uint32_t n = 0; n < curves_.nodes.size(); ++n)
      if (const Point& x = curves_.nodes[n]; on_lattice(x))
        at[{long(x.y()), long(x.x())}] = n;
      else
        others.push_back(n);
    auto& points = result_.points;
    for (long j = 0; j <= rows_; ++j) {
      points.begin_row();
      long next = 0;  // all columns from there to a mark are as the first of them is
      const auto add_up_to = [&](long mark) {
        if (next < mark && in_outline(double(next), double(j))) points.add({next, mark});
      };
      for (const auto& mark : near_.row(j)) {
        const long i = mark.column;
        add_up_to(i);
        next = i + 1;
        const auto found = at.find({j, i});
        if (found != at.end()) node_[found->second] = points.size();
        if (found != at.end() || (!mark.left_out && in_outline(double(i), double(j)))) points.add({i, i + 1});
      }
      add_up_to(columns_ + 1);
    }
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const Point &x = curves_.nodes[a], &y = curves_.nodes[b];
      return x.y() != y.y() ? x.y() < y.y() : x.x() < y.x();
    };
    std::sort(others.begin(), others.end(), before);
    for (const auto n : others) {
      node_[n] = points.size() + std::uint32_t(result_.others.size());
      result_.others.push_back(curves_.nodes[n]);
    }
  }

  void find_squares(long j) {
    const auto blocked = near_.blocked(j);
    std::vector<Columns> single, doubtful;  // those of which each has to be looked at
    for (const auto i : blocked) single.emplace_back(i, i + 1);
    for (const long row : {j, j + 1}) {
      std::vector<Columns> beside;
      for (const auto& mark : near_.row(row)) beside.emplace_back(mark.column - 1, mark.column + 1);
      doubtful = joined(doubtful, beside);
    }
    std::vector<Columns> whole;
    for (auto [from, to] : common(result_.points.columns(j), result_.points.columns(j + 1)))
      if (from < --to) whole.emplace_back(from, to);
    auto found = without(without(whole, single), doubtful);
    for (const auto& [from, to] : common(without(whole, single), doubtful))
      for (long i = from; i < to; ++i)
        if (in_outline(double(i) + 0.5, double(j) + 0.5)) found.emplace_back(i, i + 1);
    std::ranges::sort(found);
    result_.squares.begin_row();
    for (const auto& columns : found) result_.squares.add(columns);
  }

  /// Squares of a row beside which there may be none, or a curve along their sides.
  std::vector<long> rim_squares(long j) const {
    const auto& squares = result_.squares;
    const auto own = squares.columns(j);
    std::vector<Columns> some;
    for (const auto& [from, to] : own) some.emplace_back(from, from + 1), some.emplace_back(to - 1, to);
    for (const auto& mark : near_.row(j)) some.emplace_back(mark.column, mark.column + 1);
    for (const auto& mark : near_.row(j + 1)) some.emplace_back(mark.column - 1, mark.column);
    std::ranges::sort(some);
    for (const long other : {j - 1, j + 1}) some = joined(some, without(own, squares.columns(other)));
    std::vector<long> result;
    for (const auto& [from, to] : common(own, joined(some, {})))
      for (long i = from; i < to; ++i) result.push_back(i);
    return result;
  }

  /// Sides of squares beyond which there are triangles, and pieces of curves that are not sides of squares.
  std::set<Side> rims() {
    std::set<Side> result;
    std::map<Side, int> squares_at;  // pieces: squares on their sides
    constexpr std::array<std::array<long, 2>, 4> steps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    for (long j = 0; j < rows_; ++j)
      for (const long i : rim_squares(j)) {
        const auto square = result_.square(i, j);
        const bool by_curve = near_.near(i, j) || near_.near(i + 1, j + 1);
        for (std::size_t c = 0; c < 4; ++c) {
          const bool beyond = is_square(i + steps[c][0], j + steps[c][1]);
          if (beyond && !by_curve) continue;
          const auto side = sides(square[c], square[(c + 1) % 4]);
          const auto edge = edge_of_.find(side);
          if (edge != edge_of_.end()) ++squares_at[side];
          if (beyond || (edge != edge_of_.end() && edge->second != Curves::crack)) continue;
          result.insert(side);
          fences_.push_back({square[c], square[(c + 1) % 4], false, true});
        }
      }
    for (const auto& [side, edge] : edge_of_)
      if (squares_at[side] < (edge == Curves::crack ? 2 : 1)) result.insert(side);
    const auto of_edges = geometry::fences(result_.pieces);
    fences_.insert(fences_.end(), of_edges.begin(), of_edges.end());
    return result;
  }

  /// Points of the lattice that are no corner of a square.
  void take_bare(std::set<std::uint32_t>& taken) const {
    const auto corners = [&](long j) {
      auto result = result_.squares.columns(j);
      for (auto& columns : result) ++columns.second;
      return result;
    };
    for (long j = 0; j <= rows_; ++j)
      for (const auto& [from, to] : without(result_.points.columns(j), joined(corners(j - 1), corners(j))))
        for (long i = from; i < to; ++i) taken.insert(*result_.points.at(i, j));
  }

  void fill_the_rest() {
    const auto rim = rims();
    std::set<std::uint32_t> taken;
    for (const auto& [a, b] : rim) taken.insert(a), taken.insert(b);
    for (std::uint32_t n = 0; n < result_.others.size(); ++n) taken.insert(result_.points.size() + n);
    take_bare(taken);
    if (taken.empty()) return;
    auto& point = result_.about;
    point.assign(taken.begin(), taken.end());
    std::vector<Point> places;
    std::map<std::uint32_t, std::uint32_t> index;
    for (const auto k : point) index[k] = std::uint32_t(places.size()), places.push_back(result_.position(k));
    std::vector<std::array<std::uint32_t, 2>> pieces;
    for (const auto& [a, b] : rim) pieces.push_back({index[a], index[b]});
    std::vector<Fence> parted;
    for (auto fence : fences_) {
      if (!rim.contains(sides(fence.from, fence.to))) continue;
      fence.from = index[fence.from], fence.to = index[fence.to];
      parted.push_back(fence);
    }
    const auto found = required_triangles(places, pieces);
    const auto inside = geometry::within(found, parted);
    for (std::size_t t = 0; t < inside.size(); ++t)
      if (const auto& [a, b, c] = found.corners[t]; inside[t])
        result_.triangles.push_back({point[a], point[b], point[c]});
  }

  const Curves& curves_;
  const long columns_, rows_;  // of squares
  const NearCurves near_;
  std::vector<std::uint32_t> node_;  // per node of the curves: which point
  std::map<Side, std::int32_t> edge_of_;
  std::vector<Fence> fences_;  // between squares, triangles and what is beside the plate
  LatticeCells result_;
};

}  // namespace

Point LatticeCells::position(std::uint32_t k) const {
  if (k >= points.size()) return others[k - points.size()];
  const auto [i, j] = points.place(k);
  return {double(i), double(j)};
}

Tessellation::Square LatticeCells::square(long i, long j) const {
  const auto below = *points.at(i, j), above = *points.at(i, j + 1);
  return {below, below + 1, above + 1, above};
}

Cells LatticeCells::cells() const {
  Cells result{{}, {}, triangles, pieces};
  for (long j = 0; j < points.rows(); ++j)
    for (const auto& [from, to] : points.columns(j))
      for (long i = from; i < to; ++i) result.positions.emplace_back(double(i), double(j));
  result.positions.insert(result.positions.end(), others.begin(), others.end());
  for (long j = 0; j < squares.rows(); ++j)
    for (const auto& [from, to] : squares.columns(j)) {
      auto [below, right, across, above] = square(from, j);
      for (long i = from; i < to; ++i) result.squares.push_back({below++, right++, across++, above++});
    }
  return result;
}

LatticeCells lattice_cells(const Curves& curves, double clearance) {
  return Builder(curves, clearance).cells();
}

}  // namespace geometry
