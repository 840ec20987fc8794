#include "tests/unit/geometry/cells/checked_cells.hpp"

using namespace checked_cells;

TEST_CASE("graded cells fill any plate, and borders lie on its curves") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const auto plate = random_plates::Maker(seed).plate();
    CAPTURE(seed);
    const auto& grading = seed % 2 == 0 ? by_tips : by_fine_tips;
    check(plate, tessellation(plate.outline, random_plates::paths(plate), 0.3, {}, grading), 1e-12);  // measured: 2e-14
  }
}

TEST_CASE("points on the faces of a crack are seen on their side at any scale") {
  for (const double at_tips : {1e-2, 1e-4, 1e-6})
    for (int degrees = 0; degrees <= 45; degrees += 5) {
      const auto cells = inclined(degrees, at_tips, 0.4);
      const auto seen = positions_inside_faces(cells);
      const double angle = degrees * std::numbers::pi / 180;
      const Point along(std::cos(angle), std::sin(angle));
      std::vector<char> face(seen.size(), 0);
      for (const auto& border : cells.borders)
        if (border.edge == Curves::crack) face[border.from] = face[border.to] = 1;
      int wrong = 0, count = 0;
      for (const auto& triangle : cells.triangles)
        for (const auto k : triangle) {
          if (!face[k] || std::abs(along.dot(cells.positions[k])) > 0.3 - 1e-9) continue;
          double sum = 0;  // of what is beside the crack in this cell
          for (const auto j : triangle) sum += cross(along, cells.positions[j]);
          ++count, wrong += sum * cross(along, seen[k]) <= 0;
          wrong += std::abs(cross(along, seen[k])) < 5e-7 * at_tips;
        }
      CHECK(count > 20);
      CHECK(wrong == 0);
    }
}
