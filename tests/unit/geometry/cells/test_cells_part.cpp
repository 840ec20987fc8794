#include "geometry/cells/cells_part.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/plate/galerkin_plate.hpp"

using namespace geometry;

TEST_CASE("points shared out: every part has about as many, and rows of a lattice stay whole") {
  for (const auto& cells : galerkin_plate::scenes())
    for (const int parts : {1, 2, 3, 4, 7}) {
      const auto owners = shared_out(cells.positions, parts);
      CHECK(owners == shared_out(cells.positions, parts));
      for (int part = 0; part < parts; ++part) {
        const double share = double(std::ranges::count(owners, part)) * parts / double(owners.size());
        CHECK(share > 0.8);  // halved three times, each by 5 % at most
        CHECK(share < 1.2);
      }
    }
  std::vector<Point> lattice;
  for (int row = 0; row < 141; ++row)
    for (int column = 0; column < 50; ++column) lattice.emplace_back(column, row);
  const auto owners = shared_out(lattice, 3);
  for (std::size_t k = 1; k < lattice.size(); ++k)
    if (lattice[k].y() == lattice[k - 1].y()) CHECK(owners[k] == owners[k - 1]);
}

TEST_CASE("points shared out: those at one place may be anywhere, and none is lost") {
  const auto owners = shared_out(std::vector<Point>(20, Point(1, 2)), 4);
  for (int part = 0; part < 4; ++part) CHECK(std::ranges::count(owners, part) == 5);
}

TEST_CASE("cells about points: families of these and of their neighbours are those of the whole") {
  for (const auto& whole : galerkin_plate::scenes()) {
    const auto owners = shared_out(whole.positions, 5);
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
