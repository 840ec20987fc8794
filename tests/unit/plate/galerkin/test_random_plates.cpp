#include "plate/galerkin/families.hpp"
#include "tests/catch.hpp"
#include "tests/unit/geometry/random_plates.hpp"

using namespace plate;

namespace {

double residual(const geometry::Tessellation& cells) {
  const auto found = consistency_residuals(galerkin_families(cells), cells);
  return std::max(found.first, found.second);
}

}  // namespace

TEST_CASE("families obey Gauss's theorem in any plate, turned and far from the origin too") {
  double worst = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    random_plates::Maker maker(seed);
    auto plate = maker.plate();
    const auto families_of = [&](double spacing, const geometry::Grading& grading) {
      return residual(geometry::tessellation(plate.outline, random_plates::paths(plate), spacing, {}, grading));
    };
    worst = std::max(worst, families_of(0.2, {}));
    if (seed % 3 == 0) worst = std::max(worst, families_of(0.3, {1e-4, 0.1, 0.5}));
    plate = random_plates::moved(plate, maker.uniform(0, 6), {1e5, -7e4});
    worst = std::max(worst, families_of(0.15, seed % 3 == 1 ? geometry::Grading{0.02, {}, 0.3} : geometry::Grading{}));
  }
  CHECK(worst < 1e-13);  // measured: 3e-15
}

TEST_CASE("families obey Gauss's theorem with points a million times closer together at tips") {
  const auto plate = geometry::rectangle(-1, -1, 1, 1);
  for (const double at_tips : {1e-2, 1e-4, 2e-6})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const double angle = degrees * std::numbers::pi / 180;
      const geometry::Point end(0.3 * std::cos(angle), 0.3 * std::sin(angle));
      const auto paths = geometry::crack_paths(plate, {geometry::Polyline{geometry::Point(-end), end}}, 1e-9);
      const auto cells = geometry::tessellation(plate, paths, 0.2, {}, {at_tips, {}, 0.4});
      CHECK(residual(cells) < 1e-13);  // measured: 4e-16
    }
}
