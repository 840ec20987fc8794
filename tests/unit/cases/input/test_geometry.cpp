#include <fmt/format.h>
#include <numbers>

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

TEST_CASE("cracks by arcs, splines and points of a file") {
  const auto cracks = [](const std::string& of) { return with_line(plain, 7, "cracks = [" + of + "]"); };
  const auto arc = read(cracks("{ arc = [0, 0, 0.5, 30, 150] }"));
  REQUIRE(arc.content.cracks.size() == 1);
  CHECK(arc.source.notes.empty());
  for (const auto& x : arc.content.cracks[0]) CHECK(x.norm() == Approx(0.5));
  CHECK(arc.content.cracks[0].front().y() == Approx(0.25));
  const auto spline = read(cracks("{ spline = [[-0.5, 0], [0, 0.2], [0.5, 0]] }, [[-0.5, 0.5], [0.5, 0.5]]"));
  CHECK(spline.content.cracks[0].size() > 30);
  CHECK(spline.content.cracks[1].size() == 2);
  std::string points;
  for (int i = 0; i <= 12; ++i) {
    const double angle = std::numbers::pi * (1 + 4 * i / 12.0) / 6;
    points += fmt::format("{}[{}, {}]", i ? ", " : "", 0.5 * std::cos(angle), 0.5 * std::sin(angle));
  }
  const auto drawn = read(cracks("[" + points + "]"));
  REQUIRE(drawn.source.notes.size() == 1);
  CHECK_THAT(drawn.source.notes[0], Catch::Contains("geometry.cracks[0]: 12 pieces with bends up to 10 degrees"));
  CHECK(drawn.content.cracks[0].size() > 100);
  expect(cracks("{ arc = [0, 0, -1, 30, 150] }"), ":7", "geometry.cracks[0].arc", "[x, y, radius, from, to]");
  expect(cracks("{ arc = [0, 0, 0.5, 30, 390] }"), ":7", "geometry.cracks[0].arc", "less than 360 degrees");
  expect(cracks("{ spline = [[0, 0], [1, 0]] }"), ":7", "geometry.cracks[0].spline", "at least three points");
  expect(cracks("{ }"), ":7", "geometry.cracks[0]", "{ arc = [...] }");
  expect(cracks("{ arc = [0, 0, 0.5, 30, 150], scale = 2 }"), ":7", "geometry.cracks[0].scale", "is of file");
  expect(cracks("{ file = \"missing.csv\", tolerance = 0.01 }"), ":7", "geometry.cracks[0].file", "missing.csv");
  expect(cracks("{ circle = [0, 0, 1] }"), ":7", "geometry.cracks[0].circle", "");
}
