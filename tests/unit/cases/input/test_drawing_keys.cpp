#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/cases/input/dxf_text.hpp"

using namespace dxf_text;
using case_text::problems;

namespace {

/// The plain case with a drawing, `more` keys of it, and another outline where one is given.
std::string with_drawing(const std::string& name, const std::string& more = "scale = 0.001",
                         const std::string& units = "SI") {
  auto text = case_text::with_line(case_text::plain, 6,
                                   "drawing = { file = \"" + name + "\"" + (more.empty() ? "" : ", " + more) + " }");
  text = case_text::with_line(text, 7, "");
  return "units = \"" + units + "\"\n" + text;
}

const std::string plate_in_mm = rectangle("outline", -1000, -1000, 1000, 1000) + circle("holes", 500, 500, 100) +
                                line("cracks", -300, 0, 300, 0) + dxf_text::arc("cracks", 0, -500, 200, 30, 150);

}  // namespace

TEST_CASE("a drawing is the outline, holes and cracks of a case", "[drawing]") {
  const dxf_text::File drawn(file(plate_in_mm, 4));
  const auto read = case_text::read(with_drawing(drawn.name(), ""));
  const auto& content = read.content;
  CHECK(content.outline.outer.vertices == geometry::rectangle(-1, -1, 1, 1).outer.vertices);
  CHECK(content.outline.outer.edge_names[3] == "left");
  const auto& hole = std::get<geometry::Circle>(content.outline.holes.at(0));
  CHECK((hole.centre == geometry::Point(0.5, 0.5) && hole.radius == 0.1 && hole.name == "hole0"));
  REQUIRE(content.cracks.size() == 2);
  CHECK(content.cracks[0] == geometry::Polyline{{-0.3, 0}, {0.3, 0}});
  for (const auto& x : content.cracks[1]) CHECK((x - geometry::Point(0, -0.5)).norm() == Approx(0.2));
  REQUIRE(read.source.notes.size() == 1);
  CHECK_THAT(read.source.notes[0], Catch::Contains("times 0.001, has 4 edges, 1 hole and 2 cracks"));
  // the resolved case has numbers, and reads the same
  const auto resolved = cases::resolved_toml(content);
  CHECK(resolved.find("dxf") == std::string::npos);
  CHECK(cases::resolved_toml(case_text::read(resolved).content) == resolved);
}

TEST_CASE("a drawing adds to what the case has", "[drawing]") {
  const dxf_text::File drawn(file(line("RISS", 0, 0, 0.3, 0)));
  auto text = with_drawing(drawn.name(), "scale = 1, cracks = \"riss\", origin = [0.1, 0.2]");
  text = case_text::with_line(text, 8, "outline = { rectangle = [-1, -1, 1, 1] }\ncracks = [[[-0.5, 0], [-0.2, 0]]]");
  const auto cracks = case_text::read(text).content.cracks;
  REQUIRE(cracks.size() == 2);
  CHECK(cracks[1][1].x() == Approx(0.4));
  CHECK(cracks[1][1].y() == Approx(0.2));
}

TEST_CASE("units of a drawing agree with the case or are overridden", "[drawing]") {
  const dxf_text::File in_mm(file(plate_in_mm, 4)), unitless(file(plate_in_mm));
  const auto scale = "geometry.drawing.scale";
  case_text::expect(with_drawing(unitless.name(), ""), ":7", scale, "states no unit, and the case has units = \"SI\"");
  case_text::expect(with_drawing(in_mm.name(), "", "none"), ":7", scale, "is in mm, and the case has units = \"none\"");
  CHECK(problems(with_drawing(unitless.name(), "scale = 0.001")).empty());
  CHECK(problems(with_drawing(in_mm.name(), "scale = 0.001", "none")).empty());
  const auto overridden = case_text::read(with_drawing(in_mm.name(), "scale = 0.01"));
  CHECK(overridden.content.outline.outer.vertices[1].x() == 10);
  CHECK_THAT(overridden.source.notes.at(0), Catch::Contains("= 0.01 overrides the unit of the drawing, mm = 0.001 m"));
}

TEST_CASE("what is wrong with a drawing is told at once", "[drawing]") {
  using Catch::Contains;
  const auto file_key = "geometry.drawing.file";
  case_text::expect(with_drawing("not_there.dxf"), ":7", file_key, "\"not_there.dxf\": there is no such file");
  const dxf_text::File wrong(file(line("outline", 0, 0, 1000, 0) + line("outline", 1000, 0, 1000, 900) +
                                  line("holes", 0, 0, 10, 0) + "0\nELLIPSE\n8\ncracks\n"));
  case_text::expect(with_drawing(wrong.name()), ":7", file_key, "ELLIPSE on layer cracks");
  const dxf_text::File open(
      file(line("outline", 0, 0, 1000, 0) + line("outline", 1000, 0, 1000, 900) + line("holes", 0, 0, 10, 0)));
  const auto found = problems(with_drawing(open.name()));
  REQUIRE(found.size() == 4);  // both ends of both layers
  CHECK_THAT(found[0].what, Contains("layer outline is open at [0, 0]"));
  CHECK_THAT(found[3].what, Contains("layer holes is open at [10, 0]"));
  const dxf_text::File other(file(rectangle("Umriss", 0, 0, 1, 1)));
  case_text::expect(with_drawing(other.name()), ":7", "geometry.drawing.outline",
                    "has the layer \"outline\"; layers of the drawing: \"Umriss\"");
  CHECK(problems(with_drawing(other.name(), "outline = \"umriss\", scale = 1")).empty());
  case_text::expect(with_drawing(other.name(), "outline = \"umriss\", scale = 1, cracks = \"riss\""), ":7",
                    "geometry.drawing.cracks", "\"riss\"");
  case_text::expect(with_drawing(other.name(), "outline = \"umriss\", scale = 1, holes = \"Umriss\""), ":7",
                    "geometry.drawing", "two meanings");
  case_text::expect(case_text::with_line(with_drawing(other.name(), "outline = \"umriss\", scale = 1"), 8,
                                         "outline = { rectangle = [0, 0, 1, 1] }"),
                    ":8", "geometry.outline", "the drawing has an outline too");
  case_text::expect(case_text::with_line(case_text::plain, 6, "# none"), ":5", "geometry.outline",
                    "is missing, must be [xmin, ymin, xmax, ymax]");
}
