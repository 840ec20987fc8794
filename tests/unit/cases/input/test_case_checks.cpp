#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("supports are checked against the plate") {
  const auto support = [](const std::string& lines) { return plain + "[[support]]\n" + lines + "\n"; };
  expect(with_line(plain, 12, "edges = [\"lefd\"]"), ":12", "support[0].edges", "did you mean 'left'?");
  expect(with_line(plain, 12, "edges = [\"lefd\"]"), ":12", "support[0].edges", "its edges:");
  expect(with_line(plain, 11, "kind = \"clampd\""), ":11", "support[0].kind", "did you mean 'clamped'?");
  expect(with_line(plain, 12, "edges = []"), ":12", "support[0].edges", "at least one");
  expect(with_line(plain, 12, "edges = [\"left\", \"left\"]"), ":12", "support[0].edges", "named twice");
  expect(support("kind = \"free\"\nedges = [\"top\", \"left\"]"), ":20", "support[1].edges",
         "already held by support[0]");
  expect(support("kind = \"pinned\"\nedges = [\"top\"]\npoints = [[0, 0.5]]"), ":20", "support[1].edges",
         "other than pinned only");
  expect(support("kind = \"free\"\nedges = [\"top\"]\npoints = [[0, 0.5]]"), ":21", "support[1].points",
         "kind = pinned only");
  expect(support("kind = \"pinned\"\npoints = [[1, 1], [2, 0]]"), ":20", "support[1].points", "[2, 0] given");
  CHECK(problems(support("kind = \"pinned\"\npoints = [[1, 1], [0, 0.5]]")).empty());
}

TEST_CASE("supports that mirror need edges parallel to the axes, with bonds") {
  const std::vector<std::string> bonds{"discretization.formulation=ordinary"};
  const std::string slanted = with_line(
      with_line(plain, 6, "outline = { polygon = [[-1, -1], [1, -1], [1, 1], [-0.9, 1]] }"), 12, "edges = [\"edge3\"]");
  CHECK(problems(slanted).empty());
  for (const char* kind : {"symmetry", "simply_supported_hard", "clamped_layer", "simply_supported_layer",
                           "simply_supported_hard_layer"}) {
    expect(with_line(slanted, 11, "kind = \"" + std::string(kind) + "\""), ":12", "support[0].edges",
           "parallel to x or y", bonds);
    CHECK(problems(with_line(plain, 11, "kind = \"" + std::string(kind) + "\""), bonds).empty());
  }
  const std::string holed =
      with_line(with_line(plain, 6, "outline = { rectangle = [-1, -1, 1, 1] }\nholes = [{ circle = [0.5, 0.5, 0.1] }]"),
                13, "edges = [\"hole0\"]");
  CHECK(problems(holed).empty());
  expect(with_line(holed, 12, "kind = \"symmetry\""), ":13", "support[0].edges", "parallel to x or y", bonds);
  CHECK(problems(with_line(holed, 12, "kind = \"symmetry\"")).empty());  // the Galerkin plate
}

TEST_CASE("loads are checked against the plate and against themselves") {
  const auto load = [](const std::string& lines) { return plain + "[[load]]\n" + lines + "\n"; };
  expect(with_line(with_line(with_line(plain, 13, ""), 14, ""), 15, ""), "", "load", "nothing loads the plate");
  expect(load("kind = \"edge_shear\"\nvalue = 1"), ":18", "load[1].edges", "is missing");
  expect(load("kind = \"edge_shear\"\nvalue = 1\nedges = [\"tob\"]"), ":21", "load[1].edges", "did you mean 'top'?");
  expect(load("kind = \"pressure\"\nvalue = 1\nedges = [\"top\"]"), ":21", "load[1].edges",
         "kind = edge_moment or edge_shear only");
  expect(load("kind = \"presure\"\nvalue = 1"), ":19", "load[1].kind", "did you mean 'pressure'?");
  expect(load("kind = \"point_force\"\nvalue = 1"), ":18", "load[1].position", "is missing");
  expect(load("kind = \"point_force\"\nvalue = 1\nposition = [1, 0]"), ":21", "load[1].position",
         "[1, 0] given, must lie inside");
  expect(load("kind = \"edge_shear\"\nvalue = 1\nedges = [\"top\"]\ntwist = 1"), ":22", "load[1].twist",
         "kind = edge_moment only");
  expect(load("kind = \"edge_moment\"\nvalue = 1\nedges = [\"top\"]\ntensor = [1, 2, 3]"), ":20", "load[1].value",
         "beside 'tensor'");
  expect(load("kind = \"edge_moment\"\nedges = [\"top\"]\ntensor = [1, 2]"), ":21", "load[1].tensor",
         "[Mxx, Myy, Mxy]");
  CHECK(problems(load("kind = \"edge_moment\"\nedges = [\"top\"]\ntensor = [1, 2, 3]")).empty());
}

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

TEST_CASE("intensity factors need tips and a whole normalisation") {
  const auto srif = [](const std::string& lines) { return plain + "[srif]\n" + lines + "\n"; };
  CHECK(problems(srif("")).empty());
  expect(with_line(srif(""), 7, ""), ":18", "srif", "no crack tip");
  expect(srif("normalize = { moment = 1 }"), ":18", "srif.half_length", "is missing");
  expect(srif("half_length = 1"), ":19", "srif.half_length", "with normalize only");
  expect(srif("normalize = { pressure = 1 }\nhalf_length = 1"), ":19", "srif.normalize", "either { pressure");
  expect(srif("normalize = { pressure = 1, width = 1, moment = 1 }\nhalf_length = 1"), ":19", "srif.normalize",
         "either { pressure");
  expect(srif("rows = 3"), ":19", "srif.rows", "an integer in [1, 2]");
  expect(srif("window = 0.1\nwindow_horizons = 2"), ":20", "srif.window_horizons", "beside 'window'");
}

TEST_CASE("output is checked") {
  const auto output = [](const std::string& lines) { return plain + "[output]\n" + lines + "\n"; };
  expect(output("fields = [\"vtk\", \"hdf\"]"), ":19", "output.fields", "did you mean 'hdf5'?");
  expect(output("probes = { far = [3, 0] }"), ":19", "output.probes.far", "[3, 0] given");
  expect(output("probes = { far = 3 }"), ":19", "output.probes.far", "[x, y]");
}
