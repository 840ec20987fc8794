#include <fmt/format.h>
#include <numbers>

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

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
  expect(cracks("{ file = \"missing.csv\", within = 0.01 }"), ":7", "geometry.cracks[0].file", "missing.csv");
  expect(cracks("{ circle = [0, 0, 1] }"), ":7", "geometry.cracks[0].circle", "");
}
