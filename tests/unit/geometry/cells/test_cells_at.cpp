#include "tests/catch.hpp"
#include "tests/unit/geometry/cells/lattices.hpp"

using namespace lattices;

TEST_CASE("cells at a box: those of the whole with a corner there, with their points, in the same order") {
  std::size_t some = 0, parted = 0;
  for_lattices([&](const GlobalLattice& lattice) {
    const auto whole = lattice.cells();
    CHECK(whole.positions.size() == lattice.size());
    const auto [columns, rows] = lattice.last();
    for (const auto& box :
         {CellBox{{columns / 3, rows / 4}, {columns / 2 + 1, rows / 2 + 1}}, CellBox{{-3, -2}, {columns / 2, rows + 9}},
          CellBox{{columns / 2, rows / 2}, {99999, 99999}}}) {
      const auto found = lattice.cells_at(box);
      const auto wanted = taken(whole, box);
      check_same(found, wanted);
      some += found.number.size() > 0 && found.number.size() < whole.positions.size();
      for (const auto& border : found.cells.borders) parted += border.edge == Curves::crack;
    }
  });
  CHECK(some > 100);
  CHECK(parted > 1000);
}
