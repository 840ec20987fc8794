#include "tests/unit/geometry/cells/checked_cells.hpp"

using namespace checked_cells;

TEST_CASE("cells of a lattice fill any plate, and borders lie on its curves") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const auto plate = random_plates::Maker(seed).plate();
    CAPTURE(seed);
    for (const double spacing : {0.2, 0.07})
      check(plate, tessellation(plate.outline, random_plates::paths(plate), spacing, {}, {}),
            1e-12);  // measured: 2e-14
  }
}

TEST_CASE("cells fill any plate that is turned and far from the origin") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    random_plates::Maker maker(seed);
    const auto plate = random_plates::moved(maker.plate(), maker.uniform(0, 6), {1e5, -7e4});
    CAPTURE(seed);
    const Grading grading = seed % 3 == 0 ? by_tips : Grading{};
    check(plate, tessellation(plate.outline, random_plates::paths(plate), 0.1, {}, grading), 1e-9);  // measured: 6e-12
  }
}
