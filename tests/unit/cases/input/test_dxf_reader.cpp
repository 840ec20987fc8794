#include "cases/input/dxf_reader.hpp"

#include <numbers>

#include "tests/catch.hpp"
#include "tests/unit/cases/input/dxf_text.hpp"

using namespace dxf_text;
using geometry::Point;

namespace {

cases::DxfDrawing drawing(const std::string& text) {
  const dxf_text::File file(text);
  return cases::read_dxf(file.path(), {"a"});
}

cases::DxfDrawing entities(const std::string& text) {
  return drawing(dxf_text::file(text));
}

/// The one problem of a drawing.
std::string problem_of(const std::string& text) {
  const auto found = drawing(text);
  INFO(text);
  REQUIRE(found.problems.size() == 1);
  return found.problems.front();
}

}  // namespace

TEST_CASE("curves of a DXF file", "[drawing]") {
  const auto found = drawing(file(line("A", 0, 0, 3, 4) + line("b", 0, 0, 1, 0) + circle("a", 1, 2, 0.5) +
                                      dxf_text::arc("a", 0, 0, 2, 350, 10) + "0\nTEXT\n8\na\n1\nnote\n",
                                  4));
  CHECK(found.problems.empty());
  CHECK(found.unit == 4);
  CHECK(found.layers == std::set<std::string>{"A", "a", "b"});
  REQUIRE(found.pieces.size() == 3);
  CHECK(found.pieces[0].straight());
  CHECK(found.pieces[0].points.back() == Point(3, 4));
  CHECK(found.pieces[0].line == 16);
  CHECK(found.pieces[1].circle->radius == 0.5);
  CHECK(found.pieces[1].points.front() == found.pieces[1].points.back());
  const auto& of_arc = found.pieces[2].points;
  CHECK(of_arc.front().y() == Approx(2 * std::sin(-std::numbers::pi / 18)));
  CHECK(of_arc.back().y() == Approx(2 * std::sin(std::numbers::pi / 18)));
  CHECK(geometry::length(of_arc) == Approx(2 * std::numbers::pi / 9));
}

TEST_CASE("polylines of both kinds have the arcs of their bulges", "[drawing]") {
  for (const double bulge : {0.1, 0.41421356237309503, 1.0, 2.5, -0.3, -1.0}) {
    const Vertices vertices{{0, 0, bulge}, {2, 0, 0}, {2, 1, 0}};
    for (const bool old : {false, true}) {
      CAPTURE(bulge, old);
      const auto found = entities(old ? old_polyline("a", vertices, true) : polyline("a", vertices, true));
      REQUIRE(found.pieces.size() == 3);
      const auto& piece = found.pieces[0];
      REQUIRE(piece.circle);
      const double angle = 4 * std::atan(bulge), radius = 1 / std::abs(std::sin(angle / 2));
      CHECK(piece.circle->radius == Approx(radius));
      CHECK(piece.points.front() == Point(0, 0));
      CHECK(piece.points.back() == Point(2, 0));
      CHECK(geometry::length(piece.points) == Approx(std::abs(angle) * radius).epsilon(1e-4));
      // the height of the arc over its chord is bulge times half the chord, to the right of the way
      double lowest = 0;
      for (const Point& x : piece.points) lowest = bulge > 0 ? std::min(lowest, x.y()) : std::max(lowest, x.y());
      CHECK(lowest == Approx(-bulge).epsilon(1e-4));
      CHECK(found.pieces[2].points.back() == Point(0, 0));
      CHECK(found.pieces[2].straight());
    }
    CHECK(entities(polyline("a", vertices, false)).pieces.size() == 2);
  }
}

TEST_CASE("splines are evaluated, with weights and corners", "[drawing]") {
  const double half = std::sqrt(0.5);
  // a quarter of a circle as a rational spline
  const auto quarter = entities(spline("a", 2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, half, 1}));
  REQUIRE(quarter.pieces.size() == 1);
  for (const Point& x : quarter.pieces[0].points) CHECK(x.norm() == Approx(1).epsilon(1e-6));
  CHECK(geometry::length(quarter.pieces[0].points) == Approx(std::numbers::pi / 2).epsilon(1e-5));
  // without weights the parabola x = 1 - t^2, y = 1 - (1 - t)^2
  const auto parabola = entities(spline("a", 2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  double off = 0;
  for (const Point& x : parabola.pieces.at(0).points) {
    double least = 1;
    for (double t = 0; t <= 1; t += 1e-4) least = std::min(least, (x - Point(1 - t * t, t * (2 - t))).norm());
    off = std::max(off, least);
  }
  CHECK(off < 2e-4);
  // a knot as often as the degree is a corner; degree 1 is a polyline
  const auto corner =
      entities(spline("a", 2, {0, 0, 0, 1, 1, 2, 2, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 2, 0}}));
  CHECK(corner.pieces.size() == 2);
  CHECK(entities(spline("a", 1, {0, 0, 1, 2, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}})).pieces.size() == 2);
}

TEST_CASE("entities that are no curves of the plane are problems", "[drawing]") {
  using Catch::Contains;
  const auto of = [](const std::string& text) { return problem_of(file(text)); };
  CHECK_THAT(of("0\nELLIPSE\n8\na\n10\n0\n20\n0\n11\n1\n21\n0\n40\n0.5\n"),
             Contains("line 16: ELLIPSE on layer a is not read"));
  CHECK_THAT(of("0\nINSERT\n8\na\n2\npart\n"), Contains("explode it"));
  CHECK_THAT(of(circle("a", 0, 0, 1) + "210\n0\n220\n0\n230\n-1\n"), Contains("seen from behind"));
  CHECK_THAT(of(line("a", 0, 0, 1, 0) + "30\n0\n31\n2\n"), Contains("one plane z"));
  CHECK_THAT(of(circle("a", 0, 0, -1)), Contains("radius > 0"));
  CHECK_THAT(of("0\nLINE\n8\na\n10\nzero\n20\n0\n11\n1\n21\n0\n"),
             Contains("\"zero\" where a number must be (line 20)"));
  CHECK_THAT(of("0\nLWPOLYLINE\n8\na\n90\n3\n70\n0\n10\n0\n20\n0\n10\n1\n20\n0\n"), Contains("2 vertices"));
  CHECK_THAT(of(spline("a", 2, {0, 0, 0, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}})), Contains("do not fit its degree"));
  CHECK_THAT(of("0\nSPLINE\n8\na\n71\n2\n72\n3\n73\n2\n74\n0\n10\n0\n20\n0\n"), Contains("other numbers"));
  // in a block that is inserted on another layer
  const std::string block = "0\nBLOCK\n2\npart\n8\n0\n" + circle("a", 0, 0, 1) + "0\nENDBLK\n8\n0\n";
  CHECK_THAT(problem_of(file("0\nINSERT\n8\nb\n2\npart\n", 0, block)), Contains("block \"part\""));
  CHECK(drawing(file(circle("b", 0, 0, 1), 0, block)).problems.empty());
  // passed over: paper space, and anything on other layers
  CHECK(entities("0\nLINE\n8\na\n67\n1\n10\n0\n20\n0\n11\n1\n21\n0\n").pieces.empty());
  CHECK(entities("0\nELLIPSE\n8\nb\n0\nHATCH\n8\nb\n").problems.empty());
}

TEST_CASE("files that are no whole DXF files are problems", "[drawing]") {
  using Catch::Contains;
  CHECK_THAT(problem_of(""), Contains("ends before its end"));
  CHECK_THAT(problem_of("AutoCAD Binary DXF\r\n"), Contains("binary"));
  const auto whole = file(circle("a", 0, 0, 1));
  CHECK_THAT(problem_of(whole.substr(0, whole.size() - 6)), Contains("ends before its end"));
  CHECK_THAT(problem_of(file("0\nTEXT\n1\n" + std::string(2000, 'x') + "\n")), Contains("no line of an ASCII DXF"));
  // numbers that ask for room that the file does not fill
  CHECK_THAT(problem_of(file("0\nLWPOLYLINE\n8\nb\n90\n2000000000\n")), Contains("damaged"));
  CHECK_THAT(problem_of(file("0\nSPLINE\n8\nb\n72\n-1\n")), Contains("damaged"));
  CHECK_THAT(problem_of(file("0\nLWPOLYLINE\n8\na\n90\n1\n42\n1\n10\n0\n20\n0\n")), Contains("damaged"));
  CHECK_THAT(cases::read_dxf("/nowhere/plate.dxf", {"a"}).problems.at(0), Contains("no such file"));
  CHECK_THAT(cases::read_dxf(std::filesystem::temp_directory_path(), {"a"}).problems.at(0), Contains("no such file"));
}
