#include "geometry/cells/global_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/cells/uncracked_cells.hpp"

namespace geometry {
namespace {

using Square = Tessellation::Square;

/// The cells that cracks may part or that points may be left without, and what there is of them before that.
struct Band {
  std::vector<std::pair<long, long>> places;  // of its squares: row, column
  std::vector<std::uint32_t> number;          // of its points
  Cells cells;

  std::uint32_t index(std::uint32_t k) const {
    return std::uint32_t(std::ranges::lower_bound(number, k) - number.begin());
  }
};

Band band_of(const LatticeCells& all) {
  Band result;
  result.number = all.about;
  for (const auto& piece : all.pieces) result.number.push_back(piece.from), result.number.push_back(piece.to);
  keep_once(result.number);
  for (const auto k : result.number) {
    if (k >= all.points.size()) break;
    const auto [i, j] = all.points.place(k);
    for (const long row : {j - 1, j})
      for (const long column : {i - 1, i})
        if (all.squares.run_at(column, row)) result.places.emplace_back(row, column);
  }
  keep_once(result.places);
  auto& cells = result.cells;
  for (const auto& [row, column] : result.places) {
    cells.squares.push_back(all.square(column, row));
    result.number.insert(result.number.end(), cells.squares.back().begin(), cells.squares.back().end());
  }
  keep_once(result.number);
  cells.triangles = all.triangles, cells.pieces = all.pieces;
  for_corners(cells, [&](std::uint32_t& k) { k = result.index(k); });
  for (auto& piece : cells.pieces) piece.from = result.index(piece.from), piece.to = result.index(piece.to);
  for (const auto k : result.number) cells.positions.push_back(all.position(k));
  return result;
}

}  // namespace

GlobalLattice::GlobalLattice(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing,
                             const std::vector<Point>& singles) {
  const auto [low, high] = bounding_box(outline);
  units_ = {low, spacing};
  const double noise = 8 * std::numeric_limits<double>::epsilon() * low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  const auto place = [&](const Point& x) -> Point {
    return onto_lattice(units_.to_units(x), std::max(1e-9, noise / spacing));
  };
  auto paths = cracks;
  for (auto& path : paths) std::ranges::transform(path.vertices, path.vertices.begin(), place);
  std::vector<Point> places;
  for (const auto& x : singles) places.push_back(place(x));
  const Sizing sizing = [](const Point&) { return 1.0; };
  Curves found = curves(placed(outline, place, 1 / spacing), paths, places, sizing, true);
  names_ = found.names;
  part(lattice_cells(found, 0.6));
}

/// Separates the cells along cracks and numbers the points added there after all others; leaves out points without
/// cells.
void GlobalLattice::part(LatticeCells all) {
  auto band = band_of(all);
  auto& cells = band.cells;
  const auto origin = geometry::part(cells);
  std::size_t kept = std::min<std::size_t>(1, origin.size());  // those after them are new
  while (kept < origin.size() && origin[kept] > origin[kept - 1]) ++kept;
  std::vector<std::uint32_t> gone;
  for (std::uint32_t i = 0, next = 0; i < band.number.size(); ++i)
    if (next < kept && origin[next] == i)
      ++next;
    else
      gone.push_back(band.number[i]);
  const auto of_lattice = std::ranges::lower_bound(gone, all.points.size()) - gone.begin();
  lattice_.points = all.points.except(std::span(gone).first(std::size_t(of_lattice)));
  for (std::uint32_t n = 0; n < all.others.size(); ++n)
    if (!std::ranges::binary_search(gone, all.points.size() + n)) lattice_.others.push_back(all.others[n]);
  std::vector<std::uint32_t> number;
  for (std::size_t k = 0; k < kept; ++k) {
    const auto before = band.number[origin[k]];
    number.push_back(before - std::uint32_t(std::ranges::lower_bound(gone, before) - gone.begin()));
  }
  for (std::size_t k = kept; k < origin.size(); ++k) {
    number.push_back(std::uint32_t(size()));
    lattice_.others.push_back(cells.positions[k]);
  }
  borders_ = borders(cells, origin);
  for (auto& border : borders_) border.from = number[border.from], border.to = number[border.to];
  for (const auto& corner : cells.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      longest_side_ =
          std::max(longest_side_, (cells.positions[corner[c]] - cells.positions[corner[(c + 1) % 3]]).norm());
  for_corners(cells, [&](std::uint32_t& k) { k = number[k]; });
  for (std::size_t s = 0; s < cells.squares.size(); ++s)
    if (std::ranges::any_of(cells.squares[s], [&](auto k) { return k >= lattice_.points.size(); }))
      parted_.emplace_back(band.places[s], cells.squares[s]);
  lattice_.squares = std::move(all.squares), lattice_.triangles = std::move(cells.triangles);
}

Square GlobalLattice::square(long i, long j) const {
  const auto found = std::ranges::lower_bound(parted_, std::pair(j, i), {}, &AtPlace::first);
  if (found != parted_.end() && found->first == std::pair(j, i)) return found->second;
  return lattice_.square(i, j);
}

Cell GlobalLattice::last() const {
  Point high(0, 0);
  for (const auto& u : lattice_.others) high = high.cwiseMax(u);
  for (long j = 0; j < lattice_.points.rows(); ++j)
    if (const auto row = lattice_.points.row(j); !row.empty())
      high = high.cwiseMax(Point(double(row.back().to - 1), double(j)));
  const Point u = (units_.from_lattice(high) - units_.origin) / units_.spacing;
  return {long(u.x()), long(u.y())};
}

Tessellation GlobalLattice::cells() const {
  const auto [i, j] = last();
  return cells_at({{0, 0}, {i + 2, j + 2}}).cells;
}

bool GlobalLattice::inside(long i, long j) const {
  const auto own = lattice_.points.at(i, j);
  if (!own) return false;
  for (const long row : {j - 1, j})
    for (const long column : {i - 1, i}) {
      if (!lattice_.squares.run_at(column, row)) return false;
      const auto corners = square(column, row);
      if (std::ranges::find(corners, *own) == corners.end()) return false;
    }
  return true;
}

std::optional<Cell> GlobalLattice::first_inside() const {
  for (long j = 2; j + 1 < lattice_.squares.rows(); ++j) {
    auto columns = lattice_.squares.columns(j - 2);
    for (long row = j - 1; row <= j + 1; ++row) columns = common(columns, lattice_.squares.columns(row));
    for (const auto& [from, to] : columns)
      for (long i = from + 2; i + 2 <= to; ++i) {
        bool all = true;
        for (long row = j - 1; all && row <= j + 1; ++row)
          for (long column = i - 1; all && column <= i + 1; ++column) all = inside(column, row);
        if (all) return Cell{i, j};
      }
  }
  return std::nullopt;
}

/// Makes the cells of a box.
class CellsAt {
public:
  CellsAt(const GlobalLattice& global, const CellBox& box) : global_(global), box_(box) {
    for (const auto& triangle : global.lattice_.triangles)
      if (std::ranges::any_of(triangle, [&](auto k) { return box.contains(cell_of(place(k))); }))
        triangles_.push_back(triangle);
    choose_points();
  }

  CellsPart cells() && {
    auto& cells = result_.cells;
    cells.units = global_.units_, cells.names = global_.names_;
    add_squares();
    for (const auto& [a, b, c] : triangles_) cells.triangles.push_back({local(a), local(b), local(c)});
    keep_corners();
    for (const auto& [from, to, edge] : global_.borders_) {
      const auto from_here = here(from), to_here = here(to);
      if (from_here != none && to_here != none) cells.borders.push_back({from_here, to_here, edge});
    }
    return std::move(result_);
  }

private:
  static constexpr auto none = std::uint32_t(-1);

  /// Piece of a row of points, and its position among those that may be corners.
  struct RowPiece {
    long from, to, row;
    std::uint32_t number, local;
  };

  Point place(std::uint32_t k) const { return global_.lattice_.position(k); }

  /// Collects all points that may be corners.
  void choose_points() {
    Cell low{box_.low[0] - 1, box_.low[1] - 1}, high{box_.high[0] + 1, box_.high[1] + 1};
    const auto take = [&](const auto& cell) {
      for (const auto k : cell)
        if (k >= global_.lattice_.points.size()) others_.push_back(k);
    };
    for (const auto& triangle : triangles_) {
      take(triangle);
      for (const auto k : triangle)
        for (const Eigen::Index axis : {0, 1}) {
          low[std::size_t(axis)] = std::min(low[std::size_t(axis)], long(std::floor(place(k)[axis])));
          high[std::size_t(axis)] = std::max(high[std::size_t(axis)], long(std::floor(place(k)[axis])) + 1);
        }
    }
    for (const auto& [at, square] : global_.parted_)
      if (has(at.second, at.first)) take(square);
    keep_once(others_);
    for (long j = std::max(0L, low[1]); j < std::min(high[1], global_.lattice_.points.rows()); ++j)
      for (const auto& run : global_.lattice_.points.row(j)) {
        const long from = std::max(long(run.from), low[0]), to = std::min(long(run.to), high[0]);
        if (from >= to) continue;
        row_pieces_.push_back({from, to, j, run.number + std::uint32_t(from - run.from), of_lattice_});
        of_lattice_ += std::uint32_t(to - from);
      }
    used_.assign(of_lattice_ + others_.size(), none);
  }

  /// True where this square has a corner in the box.
  bool has(long i, long j) const {
    return i + 1 >= box_.low[0] && i < box_.high[0] && j + 1 >= box_.low[1] && j < box_.high[1];
  }

  /// Index among the points that may be corners; none: it may not.
  std::uint32_t local(std::uint32_t k) const {
    if (k >= global_.lattice_.points.size()) {
      const auto found = std::ranges::lower_bound(others_, k);
      return found != others_.end() && *found == k ? of_lattice_ + std::uint32_t(found - others_.begin()) : none;
    }
    const auto after = std::ranges::upper_bound(row_pieces_, k, {}, &RowPiece::number);
    if (after == row_pieces_.begin()) return none;
    const auto& [from, to, row, number, first] = *(after - 1);
    return k - number < std::uint32_t(to - from) ? first + (k - number) : none;
  }

  std::uint32_t local(long i, long j) const {
    const auto after = std::ranges::upper_bound(row_pieces_, std::pair(j, i), {},
                                                [](const RowPiece& one) { return std::pair(one.row, one.from); });
    return (after - 1)->local + std::uint32_t(i - (after - 1)->from);
  }

  void add_squares() {
    auto& squares = result_.cells.squares;
    for (long j = std::max(0L, box_.low[1] - 1); j < std::min(box_.high[1], global_.lattice_.squares.rows()); ++j)
      for (const auto& run : global_.lattice_.squares.row(j)) {
        const long from = std::max(long(run.from), box_.low[0] - 1), to = std::min(long(run.to), box_.high[0]);
        if (from >= to) continue;
        const auto below = local(from, j), above = local(from, j + 1);
        for (std::uint32_t n = 0; n < std::uint32_t(to - from); ++n)
          squares.push_back({below + n, below + n + 1, above + n + 1, above + n});
        const auto first = squares.end() - (to - from);
        const auto& parted = global_.parted_;
        for (auto at = std::ranges::lower_bound(parted, std::pair(j, from), {}, &GlobalLattice::AtPlace::first);
             at != parted.end() && at->first < std::pair(j, to); ++at)
          std::ranges::transform(at->second, first[at->first.second - from].begin(), [&](auto k) { return local(k); });
      }
  }

  /// Keeps those candidate points that are corners of cells, and renumbers the corners.
  void keep_corners() {
    auto& cells = result_.cells;
    for_corners(cells, [&](std::uint32_t k) { used_[k] = 0; });
    const auto count = std::size_t(std::ranges::count(used_, 0U));
    cells.positions.reserve(count), cells.local.reserve(count), result_.number.reserve(count);
    const auto add = [&](std::uint32_t at, std::uint32_t number, const Point& u) {
      if (used_[at] == none) return;
      used_[at] = std::uint32_t(result_.number.size());
      result_.number.push_back(number);
      cells.local.push_back(global_.units_.spacing * u);
      cells.positions.push_back(global_.units_.from_lattice(u));
    };
    for (const auto& [from, to, row, number, first] : row_pieces_)
      for (std::uint32_t n = 0; n < std::uint32_t(to - from); ++n)
        add(first + n, number + n, {double(from + n), double(row)});
    for (std::uint32_t n = 0; n < others_.size(); ++n) add(of_lattice_ + n, others_[n], place(others_[n]));
    for_corners(cells, [&](std::uint32_t& k) { k = used_[k]; });
  }

  std::uint32_t here(std::uint32_t k) const {
    const auto at = local(k);
    return at == none ? none : used_[at];
  }

  const GlobalLattice& global_;
  const CellBox& box_;
  std::vector<Tessellation::Triangle> triangles_;  // by global numbers
  std::vector<RowPiece> row_pieces_;
  std::uint32_t of_lattice_ = 0;
  std::vector<std::uint32_t> others_;  // global numbers
  std::vector<std::uint32_t> used_;    // of the points that may be corners: number in the result, or none
  CellsPart result_;
};

CellsPart GlobalLattice::cells_at(const CellBox& box) const {
  return CellsAt(*this, box).cells();
}

}  // namespace geometry
