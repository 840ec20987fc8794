#include "geometry/cells/global_lattice.hpp"

#include "tests/catch.hpp"
#include "tests/unit/geometry/cells/lattices.hpp"

using namespace lattices;

TEST_CASE("a whole lattice: its first point with squares all about it and its neighbours, its last, its longest side") {
  std::size_t none = 0, far = 0;
  for_lattices([&](const GlobalLattice& lattice) {
    const auto whole = lattice.cells();
    std::vector<int> squares(whole.positions.size(), 0);
    for (const auto& square : whole.squares)
      for (const auto k : square) ++squares[k];
    std::vector<char> regular(squares.size(), 1);
    for (const auto& square : whole.squares)
      if (std::ranges::any_of(square, [&](auto k) { return squares[k] != 4; }))
        for (const auto k : square) regular[k] = 0;
    for (std::size_t k = 0; k < squares.size(); ++k) regular[k] = regular[k] && squares[k] == 4;
    const auto first = std::ranges::find(regular, char(1));
    const auto found = lattice.first_inside();
    REQUIRE(found.has_value() == (first != regular.end()));
    none += !found;
    if (found) CHECK(cell_of(whole.units.to_lattice(whole.positions[std::size_t(first - regular.begin())])) == *found);
    Point high(0, 0);
    for (const auto& x : whole.positions) high = high.cwiseMax((x - whole.units.origin) / whole.units.spacing);
    CHECK(lattice.last() == Cell{long(high.x()), long(high.y())});
    double longest = 1;
    for (const auto& corner : whole.triangles)
      for (std::size_t c = 0; c < 3; ++c)
        longest =
            std::max(longest, (whole.local[corner[c]] - whole.local[corner[(c + 1) % 3]]).norm() / whole.units.spacing);
    CHECK(lattice.longest_side() == Approx(longest).epsilon(1e-12));
    far += longest > 1.5;
    CHECK(longest < 4);
  });
  CHECK(none < 10);
  CHECK(far > 10);
}
