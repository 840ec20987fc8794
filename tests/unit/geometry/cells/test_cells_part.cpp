#include "geometry/cells/cells_part.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/galerkin_plate.hpp"

using namespace geometry;

TEST_CASE("points shared out: every part has about as many") {
  for (const auto& cells :
       {galerkin_plate::cells(galerkin_plate::with_hole(), 0.01),
        galerkin_plate::cells(galerkin_plate::with_hole(), 0.1, {{{0.8, 0.42}, {1.0, 0.42}}}, {0.002, 0.01, 0.2})})
    for (const int parts : {1, 2, 3, 4, 7}) {
      const auto owners = shared_out(cells, parts);
      CHECK(owners == shared_out(cells, parts));
      for (int part = 0; part < parts; ++part) {
        const double share = double(std::ranges::count(owners, part)) * parts / double(owners.size());
        CHECK(share > 0.9);  // but for rows of 120 of 9,000 points
        CHECK(share < 1.1);
      }
    }
}

TEST_CASE("points shared out: rows of a lattice are parted at stretches of columns alone") {
  std::size_t parted = 0;
  for (const auto& cells :
       {galerkin_plate::cells(rectangle(0, 0, 1, 1.7), 0.02), galerkin_plate::cells(rectangle(0, 0, 600, 9), 1)})
    for (const int parts : {2, 3, 7}) {
      const auto owners = shared_out(cells, parts);
      for (std::size_t k = 1; k < owners.size(); ++k) {
        if (cells.positions[k].y() != cells.positions[k - 1].y() || owners[k] == owners[k - 1]) continue;
        CHECK(std::lround(cells.positions[k].x()) % columns_per_block == 0);
        ++parted;
      }
    }
  CHECK(parted > 0);
}

TEST_CASE("points shared out: those at one place may be anywhere, and none is lost") {
  Tessellation cells;
  cells.graded = true;
  cells.positions = cells.local = std::vector<Point>(20, Point(1, 2));
  const auto owners = shared_out(cells, 4);
  for (int part = 0; part < 4; ++part) CHECK(std::ranges::count(owners, part) == 5);
}

TEST_CASE("cells about points: families of these and of their neighbours are those of the whole") {
  for (const auto& whole : galerkin_plate::scenes()) {
    const auto owners = shared_out(whole, 5);
    const auto families = exact_cell_families(whole);
    std::size_t most = 0;
    for (int part = 0; part < 5; ++part) {
      std::vector<char> wanted;
      for (const int owner : owners) wanted.push_back(owner == part);
      const auto found = cells_about(whole, wanted);
      CHECK(std::ranges::is_sorted(found.number));
      most = std::max(most, whole.positions.size() - found.number.size());
      const auto own = exact_cell_families(found.cells);
      const auto members = [&](const Families& of, std::size_t k, bool part_of) {
        std::vector<std::uint32_t> result;
        for (const auto& bond : of[k]) result.push_back(part_of ? found.number[bond.neighbour] : bond.neighbour);
        return result;
      };
      for (std::size_t i = 0; i < found.number.size(); ++i) {
        const auto k = found.number[i];
        CHECK(found.cells.positions[i] == whole.positions[k]);
        CHECK(found.cells.local[i] == whole.local[k]);
        bool known = wanted[k];
        for (const auto& bond : families[k]) known = known || wanted[bond.neighbour];
        if (known) CHECK(members(own, i, true) == members(families, k, false));
      }
    }
    CHECK(most > 0);  // of some part, points are left out
  }
}
