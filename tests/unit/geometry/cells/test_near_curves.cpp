#include "geometry/cells/lattice_cells.hpp"

#include "geometry/shape/predicates.hpp"
#include "tests/catch.hpp"

using namespace geometry;

TEST_CASE("near curves: points beside edges and those that are left out, squares that a crack runs through") {
  const auto outline = rectangle(0, 0, 12, 9.3);
  CrackPath crack;
  crack.vertices = {{3.2, 4.1}, {7.4, 5.9}};
  const auto found = curves(
      outline, {crack}, {}, [](const Point&) { return 1.0; }, true);
  const NearCurves near(found, 0.6, 12, 10);
  std::size_t left_out = 0, beside = 0, blocked = 0;
  for (long j = 0; j <= 10; ++j) {
    std::vector<NearCurves::Mark> marks(near.row(j).begin(), near.row(j).end());
    for (long i = 0; i <= 12; ++i) {
      const Point x{double(i), double(j)};
      double away = 10, to_edge = 10;
      for (const auto& piece : found.pieces) {
        const double distance = distance_to_segment(found.nodes[piece.from], found.nodes[piece.to], x);
        away = std::min(away, distance);
        if (piece.edge != Curves::crack) to_edge = std::min(to_edge, distance);
      }
      const auto mark = std::ranges::find(marks, i, &NearCurves::Mark::column);
      CHECK(near.near(i, j) == (mark != marks.end()));
      if (away < 0.6) {
        REQUIRE(mark != marks.end());
        CHECK(mark->left_out);
        ++left_out;
      } else if (to_edge <= 1) {
        REQUIRE(mark != marks.end());
        CHECK_FALSE(mark->left_out);
        ++beside;
      }
    }
    for (const long i : near.blocked(j)) {
      const Point middle(double(i) + 0.5, double(j) + 0.5);
      double away = 10;
      for (const auto& piece : found.pieces)
        away = std::min(away, distance_to_segment(found.nodes[piece.from], found.nodes[piece.to], middle));
      CHECK(away < std::sqrt(0.5));
      ++blocked;
    }
  }
  CHECK(left_out > 40);
  CHECK(beside > 20);
  CHECK(blocked > 12);  // the upper edge lies between two rows
}
