#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("shapes and cracks are checked") {
  const auto outline = [](const std::string& line) { return with_line(plain, 6, line); };
  expect(outline("outline = { rectangle = [1, -1, -1, 1] }"), ":6", "geometry.outline.rectangle", "xmin < xmax");
  expect(outline("outline = { rectangle = [-1, -1, 1] }"), ":6", "geometry.outline.rectangle",
         "[xmin, ymin, xmax, ymax]");
  expect(outline("outline = { edges = [\"a\"] }"), ":6", "geometry.outline", "either { rectangle");
  expect(outline("outline = { rectangle = [-1, -1, 1, 1], edges = [\"a\"] }"), ":6", "geometry.outline.edges",
         "with a polygon only");
  expect(outline("outline = { polygon = [[-1, -1], [1, -1], [1, 1]], edges = [\"left\"] }"), ":6",
         "geometry.outline.edges", "1 names given, must be one for each of the 3 edges");
  expect(outline("outline = { rectangle = [-1, -1, 1, 1] }\nholes = [{ circle = [0, 0.5, -0.1] }]"), ":7",
         "geometry.holes[0]", "");
  expect(outline("outline = { rectangle = [-1, -1, 1, 1] }\nholes = [{ }]"), ":7", "geometry.holes[0]",
         "either { circle");
  const auto outside = problems(with_line(plain, 7, "cracks = [\n[[0, 0], [0, 0.1]],\n[[5, 0], [6, 0]]]"));
  REQUIRE_FALSE(outside.empty());
  for (const auto& problem : outside) {
    CHECK(problem.place == ":9");
    CHECK(problem.key == "geometry.cracks[1]");
  }
  expect(with_line(plain, 7, "cracks = [[[0, 0, 1]]]"), ":7", "geometry.cracks[0]", "[[x, y], ...]");
  expect(outline("outline = { polygon = [] }"), ":6", "geometry.outline.polygon", "at least three points");
  expect(with_line(plain, 7, "cracks = [[]]"), ":7", "geometry.cracks[0]", "");
  expect(with_line(plain, 7, "cracks = [[[0, 0]]]"), ":7", "geometry.cracks[0]", "");
  expect(with_line(plain, 7, "cracks = 3"), ":7", "geometry.cracks", "a list of polylines");
  const auto clockwise = problems(
      outline("outline = { polygon = [[-1, -1], [-1, 1], [1, 1], [1, -1]], edges = [\"left\", \"b\", \"c\", \"d\"] }"));
  REQUIRE(clockwise.size() == 1);
  CHECK(clockwise[0].key == "geometry.outline");
}
