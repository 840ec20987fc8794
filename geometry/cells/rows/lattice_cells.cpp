#include "geometry/cells/rows/lattice_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/cells/delaunay.hpp"
#include "geometry/cells/rows/near_curves.hpp"

namespace geometry {
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
    const auto found = delaunay(places, pieces);
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
