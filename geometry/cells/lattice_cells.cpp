#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/cells/delaunay.hpp"
#include "geometry/cells/untied_cells.hpp"
#include "geometry/shape/predicates.hpp"

namespace geometry {
namespace {

constexpr std::int32_t none = -1;

/// Does the segment pass through the open square from `low` to low + (1, 1)?
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

class Builder {
public:
  Builder(const Curves& curves, double clearance) : curves_(curves), clearance_(clearance) {
    const Point size = bounding_box(curves.outline).second;
    columns_ = long(std::ceil(size.x())), rows_ = long(std::ceil(size.y()));
    place_.assign(std::size_t((columns_ + 1) * (rows_ + 1)), none);
    near_.assign(place_.size(), 0);
    square_.assign(std::size_t(columns_ * rows_), 0);
    node_.assign(curves.nodes.size(), none);
  }

  Cells cells() {
    mark_near();
    number_points();
    find_squares();
    for (const auto& piece : curves_.pieces) {
      result_.pieces.push_back({node(piece.from), node(piece.to), piece.edge});
      edge_of_[sides(node(piece.from), node(piece.to))] = piece.edge;
    }
    fill_the_rest();
    return std::move(result_);
  }

private:
  using Side = std::pair<std::uint32_t, std::uint32_t>;
  static Side sides(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }
  std::size_t vertex(long i, long j) const { return std::size_t(j * (columns_ + 1) + i); }
  std::uint32_t node(std::uint32_t i) const { return std::uint32_t(node_[i]); }
  bool is_square(long i, long j) const {
    return i >= 0 && j >= 0 && i < columns_ && j < rows_ && square_[std::size_t(j * columns_ + i)];
  }

  /// Calls visit(i, j) for all in the box about a segment.
  template <typename Visit>
  static void about(const Point& a, const Point& b, double margin, long last_i, long last_j, const Visit& visit) {
    const auto low = [margin](double x, double y) { return std::max(0L, long(std::ceil(std::min(x, y) - margin))); };
    const auto high = [margin](double x, double y) { return long(std::floor(std::max(x, y) + margin)); };
    for (long j = low(a.y(), b.y()); j <= std::min(high(a.y(), b.y()), last_j); ++j)
      for (long i = low(a.x(), b.x()); i <= std::min(high(a.x(), b.x()), last_i); ++i) visit(i, j);
  }

  /// 1: near an edge, 2: too near a curve to stay.
  void mark_near() {
    const auto mark = [&](const Point& a, const Point& b, bool is_edge) {
      about(a, b, 1.5, columns_, rows_, [&](long i, long j) {
        const double away = distance_to_segment(a, b, Point(double(i), double(j)));
        char& state = near_[vertex(i, j)];
        if (away < clearance_)
          state = 2;
        else if (is_edge)
          state = std::max<char>(state, 1);
      });
    };
    for (const auto& x : curves_.nodes) mark(x, x, false);
    for (const auto& piece : curves_.pieces)
      mark(curves_.nodes[piece.from], curves_.nodes[piece.to], piece.edge != Curves::crack);
  }

  /// Lattice points row by row, nodes among them; the other nodes after these.
  void number_points() {
    std::map<std::size_t, std::uint32_t> at;  // nodes on lattice points
    std::vector<std::uint32_t> others;
    for (std::uint32_t n = 0; n < curves_.nodes.size(); ++n) {
      const Point& x = curves_.nodes[n];
      if (x.x() == std::round(x.x()) && x.y() == std::round(x.y()))
        at[vertex(long(x.x()), long(x.y()))] = n;
      else
        others.push_back(n);
    }
    const auto add = [&](const Point& x) {
      result_.positions.push_back(x);
      return std::int32_t(result_.positions.size() - 1);
    };
    for (long j = 0; j <= rows_; ++j) {
      bool inside = false;
      for (long i = 0; i <= columns_; ++i) {
        const auto v = vertex(i, j);
        const Point x{double(i), double(j)};
        if (near_[v] || i == 0 || near_[v - 1]) inside = near_[v] == 2 ? false : contains(curves_.outline, x);
        if (const auto found = at.find(v); found != at.end())
          place_[v] = node_[found->second] = add(x);
        else if (inside && near_[v] != 2)
          place_[v] = add(x);
      }
    }
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const Point &x = curves_.nodes[a], &y = curves_.nodes[b];
      return x.y() != y.y() ? x.y() < y.y() : x.x() < y.x();
    };
    std::sort(others.begin(), others.end(), before);
    for (const auto n : others) node_[n] = add(curves_.nodes[n]);
  }

  void find_squares() {
    std::vector<char> blocked(square_.size(), 0);
    const auto block = [&](long i, long j) { blocked[std::size_t(j * columns_ + i)] = 1; };
    for (const auto& piece : curves_.pieces) {
      const Point &a = curves_.nodes[piece.from], &b = curves_.nodes[piece.to];
      about(a, b, 1, columns_ - 1, rows_ - 1, [&](long i, long j) {
        if (enters_square(a, b, {double(i), double(j)})) block(i, j);
      });
    }
    for (const auto& x : curves_.nodes)
      if (x.x() != std::round(x.x()) || x.y() != std::round(x.y()))
        about(x, x, 1, columns_ - 1, rows_ - 1, [&](long i, long j) {
          if (x.x() >= double(i) && x.y() >= double(j)) block(i, j);
        });
    for (long j = 0; j < rows_; ++j)
      for (long i = 0; i < columns_; ++i) {
        const std::size_t corner[] = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
        bool whole = !blocked[std::size_t(j * columns_ + i)], doubtful = false;
        for (const auto v : corner) whole = whole && place_[v] != none, doubtful = doubtful || near_[v];
        if (!whole || (doubtful && !contains(curves_.outline, {double(i) + 0.5, double(j) + 0.5}))) continue;
        square_[std::size_t(j * columns_ + i)] = 1;
        Tessellation::Square square;
        for (std::size_t c = 0; c < 4; ++c) square[c] = std::uint32_t(place_[corner[c]]);
        result_.squares.push_back(square);
      }
  }

  /// Sides of squares beyond which there are triangles, and pieces of curves that are not sides of squares.
  std::set<Side> rims() {
    std::set<Side> result;
    std::map<Side, int> squares_at;  // pieces: squares on their sides
    const Point steps[] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    std::size_t n = 0;
    for (long j = 0; j < rows_; ++j)
      for (long i = 0; i < columns_; ++i) {
        if (!is_square(i, j)) continue;
        const auto& square = result_.squares[n++];
        for (std::size_t c = 0; c < 4; ++c) {
          const bool beyond = is_square(i + long(steps[c].x()), j + long(steps[c].y()));
          const bool rim = !beyond || near_[vertex(i, j)] || near_[vertex(i + 1, j + 1)];
          if (!rim) continue;
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

  void fill_the_rest() {
    const auto rim = rims();
    std::set<std::uint32_t> taken;
    for (const auto& [a, b] : rim) taken.insert(a), taken.insert(b);
    for (const auto n : node_) {
      const Point& x = result_.positions[std::size_t(n)];
      if (x.x() != std::round(x.x()) || x.y() != std::round(x.y())) taken.insert(std::uint32_t(n));
    }
    for (long j = 0; j <= rows_; ++j)
      for (long i = 0; i <= columns_; ++i)
        if (place_[vertex(i, j)] != none && !is_square(i, j) && !is_square(i - 1, j) && !is_square(i, j - 1) &&
            !is_square(i - 1, j - 1))
          taken.insert(std::uint32_t(place_[vertex(i, j)]));
    if (taken.empty()) return;
    const std::vector<std::uint32_t> point(taken.begin(), taken.end());
    std::vector<Point> places;
    std::map<std::uint32_t, std::uint32_t> index;
    for (const auto k : point) index[k] = std::uint32_t(places.size()), places.push_back(result_.positions[k]);
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
  const double clearance_;
  long columns_, rows_;              // of cells
  std::vector<std::int32_t> place_;  // per lattice point: which point, or none
  std::vector<char> near_, square_;  // per lattice point; per cell
  std::vector<std::int32_t> node_;   // per node of the curves: which point
  std::map<Side, std::int32_t> edge_of_;
  std::vector<Fence> fences_;  // between squares, triangles and what is beside the plate
  Cells result_;
};

}  // namespace

Cells lattice_cells(const Curves& curves, double clearance) {
  return Builder(curves, clearance).cells();
}

}  // namespace geometry
