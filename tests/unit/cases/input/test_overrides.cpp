// Keys that are set and keys that are taken out before a case is read.
#include <cmath>

#include "tests/catch.hpp"
#include "tests/unit/cases/case_text.hpp"

using case_text::plain, case_text::read;

TEST_CASE("overrides: a key that is taken out has its default, a table all of its keys, a list one entry less") {
  CHECK(read(plain, {"section.shear_correction=0.9", "-section.shear_correction"}).content.section.shear_correction ==
        Approx(5.0 / 6));
  CHECK(read(plain, {"-section.thickness", "section.thickness=0.2"}).content.section.thickness == 0.2);
  CHECK(read(plain + "[srif]\n", {"-srif"}).content.srif == std::nullopt);
  const auto second = read(plain + "[[load]]\nkind = \"pressure\"\nvalue = 7\n", {"-load[0]"}).content;
  CHECK(second.loads.at(0).as<plate::Pressure>()->value == 7);
  CHECK(read(plain, {"-geometry.cracks"}).content.cracks.empty());
}

TEST_CASE("overrides: taking out what is not there, or what must be there, is a problem") {
  case_text::expect(plain, "--unset srif.window", "srif.window", "is not in the file", {"-srif.window"});
  case_text::expect(plain, "--unset load[1]", "load[1]", "is not in the file", {"-load[1]"});
  case_text::expect(plain, "--unset ", "", "is not in the file", {"-"});
  const auto found = case_text::problems(plain, {"-section.young"});
  REQUIRE(found.size() == 1);
  CHECK(found[0].key == "section.young");
}

TEST_CASE("ends of cracks that are off a hole by rounding are taken to lie on it, with a word") {
  const std::string hole = "holes = [{ circle = [0.0, 0.0, 0.2] }]\n";
  const auto with = [&](const std::string& cracks) {
    return case_text::with_line(plain, 7, hole + "cracks = " + cracks);
  };
  const double x = 0.2 * std::cos(1.0), y = 0.2 * std::sin(1.0);
  const auto five_digits = with("[[[0.10806, 0.16829], [0.4, 0.6]]]");
  const auto file = read(five_digits);
  CHECK((file.content.cracks[0][0] - geometry::Point(x, y)).norm() < 1e-5);
  REQUIRE(file.source.notes.size() == 1);
  CHECK_THAT(file.source.notes[0],
             Catch::Contains("geometry.cracks[0]: its first point") && Catch::Contains("from hole0"));
  CHECK(geometry::tips(plate::crack_paths(file.content)).size() == 1);
  CHECK(read(with("[[[0.11, 0.17], [0.4, 0.6]]]")).source.notes.empty());  // 0.0025 off: a tip
}

TEST_CASE("a crack in two pieces of one line is one crack, with a note") {
  const auto file = cases::read_case_text(
      "[section]\nyoung = 1000.0\npoisson = 0.3\nthickness = 0.1\n[geometry]\n"
      "outline = { rectangle = [-1.0, -1.0, 1.0, 1.0] }\n"
      "cracks = [[[0.1, 0.05], [0.3, 0.15]], [[-0.3, -0.15], [0.0, 0.0], [0.1, 0.05]]]\n"
      "[discretization]\nspacing = 0.05\n[[support]]\nkind = \"clamped\"\nedges = [\"left\"]\n"
      "[[load]]\nkind = \"pressure\"\nvalue = 1.0\n[analysis]\nkind = \"static\"\n",
      "pieces", {});
  REQUIRE(file.content.cracks.size() == 1);
  CHECK(file.content.cracks[0] == geometry::Polyline{{0.3, 0.15}, {-0.3, -0.15}});  // the first piece's tip first
  REQUIRE(file.source.notes.size() == 1);
  CHECK_THAT(file.source.notes[0], Catch::Contains("geometry.cracks[1] continues geometry.cracks[0] in one line"));
}

TEST_CASE("a thickness beyond half of the plate's least width is noted, however the plate is turned") {
  const auto notes = [](const std::string& thickness, const std::string& outline = "rectangle = [0.0, 0.0, 1.0, 0.6]") {
    return cases::read_case_text(
               "[section]\nyoung = 210e9\npoisson = 0.3\nthickness = " + thickness + "\n[geometry]\noutline = { " +
                   outline +
                   " }\n[discretization]\nspacing = 0.02\n"
                   "[[support]]\nkind = \"clamped\"\nedges = [\"left\"]\n[[load]]\nkind = \"pressure\"\nvalue = 1.0\n"
                   "[analysis]\nkind = \"static\"\n",
               "thick", {})
        .source.notes;
  };
  CHECK(notes("0.29").empty());
  REQUIRE(notes("10.0").size() == 1);
  CHECK_THAT(notes("10.0")[0], Catch::Contains("section.thickness is 17 times the plate's least width") &&
                                   Catch::Contains("set section.thickness below 0.3"));
  // a strip of the width 0.1 along the diagonal, in a box of 0.78 by 0.78
  const std::string strip =
      "polygon = [[0.0707, 0.0], [0.7778, 0.7071], [0.7071, 0.7778], [0.0, 0.0707]], edges = ['long', 'right', "
      "'other', 'left']";
  CHECK(notes("0.045", strip).empty());
  REQUIRE(notes("0.2", strip).size() == 1);
  CHECK_THAT(notes("0.2", strip)[0], Catch::Contains("section.thickness is 2 times"));
}
