#pragma once

#include "geometry/cells/global_lattice.hpp"
#include "tests/catch.hpp"
#include "tests/unit/geometry/random_plates.hpp"

/// Plates on lattices, and parts of their cells found another way.
namespace lattices {

using namespace geometry;

/// Calls visit(GlobalLattice) for random plates, and for some along the lattice with cracks along it and across.
template <typename Visit>
void for_lattices(const Visit& visit) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    random_plates::Maker maker(seed);
    auto plate = maker.plate();
    if (seed % 3 == 1) plate = random_plates::moved(plate, maker.uniform(0, 6), {1e3, -7e2});
    CAPTURE(seed);
    visit(GlobalLattice(plate.outline, random_plates::paths(plate), seed % 2 ? 0.07 : 0.03, {}));
  }
  const auto long_plate = rectangle(0, 0, 12, 3);
  const std::vector<std::vector<Polyline>> cracks{{},
                                                  {{{1, 1}, {2, 1}}},
                                                  {{{0, 1}, {2, 1}}, {{1, 0.5}, {1, 2}}},
                                                  {{{1, 1}, {2.3, 1.7}, {4, 1.7}}},
                                                  {{{6, 0}, {6, 3}}, {{8, 1.42}, {11, 1.55}}}};
  for (const double spacing : {0.1, 0.013, 0.02})
    for (const auto& some : cracks)
      visit(GlobalLattice(long_plate, crack_paths(long_plate, some, 1e-9), spacing, {{5, 1.1}, {5.005, 1.234}}));
}

/// The cells of a whole with a corner in a box.
inline CellsPart taken(const Tessellation& whole, const CellBox& box) {
  std::vector<char> in_box;
  for (const auto& x : whole.positions) in_box.push_back(box.contains(cell_of(whole.units.to_lattice(x))));
  std::vector<char> corner(in_box.size(), 0);
  const auto has = [&](const auto& cell) { return std::ranges::any_of(cell, [&](auto k) { return in_box[k] != 0; }); };
  const auto mark = [&](const auto& cell) {
    if (has(cell))
      for (const auto k : cell) corner[k] = 1;
  };
  std::ranges::for_each(whole.squares, mark), std::ranges::for_each(whole.triangles, mark);
  CellsPart result;
  std::vector<std::uint32_t> place(corner.size(), 0);
  for (std::uint32_t k = 0; k < corner.size(); ++k)
    if (corner[k]) {
      place[k] = std::uint32_t(result.number.size());
      result.number.push_back(k);
      result.cells.positions.push_back(whole.positions[k]), result.cells.local.push_back(whole.local[k]);
    }
  const auto take = [&](auto cell, auto& cells) {
    if (!has(cell)) return;
    for (auto& k : cell) k = place[k];
    cells.push_back(cell);
  };
  for (const auto& square : whole.squares) take(square, result.cells.squares);
  for (const auto& triangle : whole.triangles) take(triangle, result.cells.triangles);
  for (const auto& [from, to, edge] : whole.borders)
    if (corner[from] && corner[to]) result.cells.borders.push_back({place[from], place[to], edge});
  result.cells.units = whole.units, result.cells.names = whole.names;
  return result;
}

inline void check_same(const CellsPart& one, const CellsPart& other) {
  CHECK(one.number == other.number);
  CHECK((one.cells.positions == other.cells.positions));
  CHECK((one.cells.local == other.cells.local));
  CHECK((one.cells.squares == other.cells.squares));
  CHECK((one.cells.triangles == other.cells.triangles));
  CHECK(one.cells.names == other.cells.names);
  CHECK(one.cells.units.origin == other.cells.units.origin);
  CHECK(one.cells.units.spacing == other.cells.units.spacing);
  const auto borders = [](const CellsPart& part) {
    std::vector<std::array<std::int64_t, 3>> result;
    for (const auto& [from, to, edge] : part.cells.borders) result.push_back({from, to, edge});
    return result;
  };
  CHECK((borders(one) == borders(other)));
}

}  // namespace lattices
