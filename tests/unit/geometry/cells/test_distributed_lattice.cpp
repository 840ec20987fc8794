#include "geometry/cells/distributed_lattice.hpp"

#include "tests/catch.hpp"
#include "tests/unit/geometry/cells/lattices.hpp"

using namespace lattices;

namespace {

void check_shares(const GlobalLattice& lattice, const std::vector<int>& counts) {
  const auto global = lattice.cells();
  CellsPart all{global, {}};
  for (std::uint32_t k = 0; k < global.positions.size(); ++k) all.number.push_back(k);
  for (const int parts : counts) {
    INFO(parts << " parts of " << all.number.size() << " points");
    const auto owners = shared_out(global, parts);
    const DistributedLattice shares(lattice, parts);
    CHECK((shares.owners(all) == owners));
    for (int one = 0; one < parts; ++one) {
      const auto& part = shares.part(one);
      CHECK(part.points == std::size_t(std::ranges::count(owners, one)));
      Point low = Point::Constant(INFINITY), high = -low;
      for (std::size_t k = 0; k < owners.size(); ++k)
        if (owners[k] == one) low = low.cwiseMin(global.positions[k]), high = high.cwiseMax(global.positions[k]);
      if (part.points == 0) continue;
      CHECK((part.low - low).norm() < 1e-6 * global.units.spacing);
      CHECK((part.high - high).norm() < 1e-6 * global.units.spacing);
    }
  }
}

}  // namespace

TEST_CASE("points of a lattice shared out without them: as by all of them, to the last") {
  for_lattices([](const GlobalLattice& lattice) { check_shares(lattice, {1, 2, 3, 4, 7, 16}); });
}

TEST_CASE("points of a lattice shared out: rows of a plate a few rows high are parted themselves") {
  const auto strip = rectangle(0, 0, 40, 0.3);
  const GlobalLattice lattice(strip, crack_paths(strip, {{{3, 0.15}, {9, 0.15}}}, 1e-9), 0.1, {});
  check_shares(lattice, {2, 5, 9, 30, 64});
  CHECK(DistributedLattice(lattice, 64).part(63).points > 8);
}
