#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

TEST_CASE("loads are checked against the plate and against themselves") {
  const auto load = [](const std::string& lines) { return plain + "[[load]]\n" + lines + "\n"; };
  expect(with_line(with_line(with_line(plain, 13, ""), 14, ""), 15, ""), "", "load", "nothing loads the plate");
  expect(load("kind = \"edge_shear\"\nvalue = 1"), ":18", "load[1].edges", "is missing");
  expect(load("kind = \"edge_shear\"\nvalue = 1\nedges = [\"tob\"]"), ":21", "load[1].edges", "did you mean 'top'?");
  expect(load("kind = \"pressure\"\nvalue = 1\nedges = [\"top\"]"), ":21", "load[1].edges",
         "kind = edge_moment or edge_shear or edge_traction only");
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

TEST_CASE("loads on a part of the plate and along lines are checked against it") {
  const auto pressure = [](const std::string& on) {
    return plain + "[[load]]\nkind = \"pressure\"\nvalue = 1\n" + on + "\n";
  };
  const auto line = [](const std::string& along) {
    return plain + "[[load]]\nkind = \"line_load\"\nvalue = 1\n" + along + "\n";
  };
  const std::string key = "load[1].on", along = "load[1].along";
  CHECK(problems(pressure("on = { circle = [0, 0, 0.3] }\ngradient = [1, 0]\nfrom = [0, 1]")).empty());
  expect(pressure("on = { circle = [0, 0, 0] }"), ":21", key, "radius 0 given, must be > 0");
  expect(pressure("on = { circle = [7, 7, 1] }"), ":21", key, "acts on nothing of the plate");
  expect(pressure("on = { polygon = [[0, 0], [0.5, 0.5], [0.5, 0], [0, 0.5]] }"), ":21", key, "cross");
  expect(pressure("on = { polygon = [[0, 0], [0.5, 0.5]] }"), ":21", key + ".polygon", "three");
  expect(pressure("on = { }"), ":21", key, "either { circle");
  expect(pressure("gradient = [1]"), ":21", "load[1].gradient", "[x, y]");
  expect(line("along = [[0, 0.5], [1, 0.5]]\non = { circle = [0, 0, 1] }"), ":22", key, "kind = pressure only");
  expect(line(""), ":18", along, "is missing");
  expect(line("along = [[0, 0]]"), ":21", along, "2 points or more");
  expect(line("along = [[0, 0.5], [3, 0.5]]"), ":21", along, "[3, 0.5] given, must lie in the plate");
  expect(line("along = [[0, 0.5], [0, 0.5]]"), ":21", along, "the line has no length");
  expect(line("along = [[-0.9, 0], [0.9, 0]]"), ":21", along, "lies along crack 0");
  expect(line("along = [[0.1, 0], [0.2, 0]]"), ":21", along, "lies along crack 0");
  CHECK(problems(line("along = [[0, -0.5], [0, 0.5]]")).empty());  // across it
}
