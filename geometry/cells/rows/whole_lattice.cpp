#include "geometry/cells/rows/whole_lattice.hpp"

#include <algorithm>
#include <limits>

#include "geometry/cells/untied_cells.hpp"

namespace geometry {
namespace {

using Square = Tessellation::Square;

void keep_once(auto& values) {
  std::ranges::sort(values);
  const auto again = std::ranges::unique(values);
  values.erase(again.begin(), again.end());
}

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
  for_cells(cells, [&](std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) corner[c] = result.index(corner[c]);
  });
  for (auto& piece : cells.pieces) piece.from = result.index(piece.from), piece.to = result.index(piece.to);
  for (const auto k : result.number) cells.positions.push_back(all.position(k));
  return result;
}

}  // namespace

WholeLattice::WholeLattice(const Outline& outline, const std::vector<CrackPath>& cracks, double spacing,
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

/// What cracks part gets its points after all others; points without cells are left out.
void WholeLattice::part(LatticeCells all) {
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
  points_ = all.points.except(std::span(gone).first(std::size_t(of_lattice)));
  for (std::uint32_t n = 0; n < all.others.size(); ++n)
    if (!std::ranges::binary_search(gone, all.points.size() + n)) others_.push_back(all.others[n]);
  std::vector<std::uint32_t> number;
  for (std::size_t k = 0; k < kept; ++k) {
    const auto before = band.number[origin[k]];
    number.push_back(before - std::uint32_t(std::ranges::lower_bound(gone, before) - gone.begin()));
  }
  for (std::size_t k = kept; k < origin.size(); ++k) {
    number.push_back(std::uint32_t(size()));
    others_.push_back(cells.positions[k]);
  }
  borders_ = borders(cells, origin);
  for (auto& border : borders_) border.from = number[border.from], border.to = number[border.to];
  for (const auto& corner : cells.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      longest_side_ =
          std::max(longest_side_, (cells.positions[corner[c]] - cells.positions[corner[(c + 1) % 3]]).norm());
  geometry::for_cells(cells, [&](std::uint32_t* corner, std::size_t count) {
    for (std::size_t c = 0; c < count; ++c) corner[c] = number[corner[c]];
  });
  for (std::size_t s = 0; s < cells.squares.size(); ++s)
    if (std::ranges::any_of(cells.squares[s], [&](auto k) { return k >= points_.size(); }))
      parted_.emplace_back(band.places[s], cells.squares[s]);
  squares_ = std::move(all.squares), triangles_ = std::move(cells.triangles);
}

Square WholeLattice::square(long i, long j) const {
  const auto found = std::ranges::lower_bound(parted_, std::pair(j, i), {}, &AtPlace::first);
  if (found != parted_.end() && found->first == std::pair(j, i)) return found->second;
  const auto below = *points_.at(i, j), above = *points_.at(i, j + 1);
  return {below, below + 1, above + 1, above};
}

Point WholeLattice::place(std::uint32_t k) const {
  if (k >= points_.size()) return others_[k - points_.size()];
  const auto [i, j] = points_.place(k);
  return {double(i), double(j)};
}

Cell WholeLattice::last() const {
  Point high(0, 0);
  for (const auto& u : others_) high = high.cwiseMax(u);
  for (long j = 0; j < points_.rows(); ++j)
    if (const auto row = points_.row(j); !row.empty())
      high = high.cwiseMax(Point(double(row.back().to - 1), double(j)));
  const Point u = (units_.from_lattice(high) - units_.origin) / units_.spacing;
  return {long(u.x()), long(u.y())};
}

Tessellation WholeLattice::cells() const {
  const auto [i, j] = last();
  return cells_at({{0, 0}, {i + 2, j + 2}}).cells;
}

bool WholeLattice::inside(long i, long j) const {
  const auto own = points_.at(i, j);
  if (!own) return false;
  for (const long row : {j - 1, j})
    for (const long column : {i - 1, i}) {
      if (!squares_.run_at(column, row)) return false;
      const auto corners = square(column, row);
      if (std::ranges::find(corners, *own) == corners.end()) return false;
    }
  return true;
}

std::optional<Cell> WholeLattice::first_inside() const {
  for (long j = 2; j + 1 < squares_.rows(); ++j) {
    auto columns = squares_.columns(j - 2);
    for (long row = j - 1; row <= j + 1; ++row) columns = common(columns, squares_.columns(row));
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

}  // namespace geometry
