#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

std::string foundation(const std::string& lines) {
  return plain + "[[foundation]]\n" + lines + "\n";
}

std::string spring(const std::string& lines) {
  return plain + "[[spring]]\n" + lines + "\n";
}

}  // namespace

TEST_CASE("foundations are checked against the plate") {
  CHECK(problems(foundation("modulus = 2.0\nshear = 1\non = { circle = [0, 0, 0.3] }")).empty());
  expect(foundation("shear = 1"), ":18", "foundation[0].modulus", "is missing");
  expect(foundation("modulus = -2"), ":19", "foundation[0].modulus", "-2 given, must be a number > 0");
  expect(foundation("modulus = 2\nshear = -1"), ":20", "foundation[0].shear", "-1 given");
  expect(foundation("modulus = 2\ntension = false"), ":20", "foundation[0].tension", "unknown");
  expect(foundation("modulus = 2\non = { circle = [7, 7, 1] }"), ":20", "foundation[0].on",
         "the foundation lies on nothing of the plate");
  expect(foundation("modulus = 2\non = { circle = [0, 0, 0] }"), ":20", "foundation[0].on", "radius 0 given");
  for (const std::string method : {"surface_nodes", "fictitious_nodes"})
    expect(foundation("modulus = 2"), "--set discretization.boundary", "discretization.boundary",
           "no place for foundations and springs",
           {"discretization.boundary=" + method, "geometry.cracks=[]", "-geometry.cracks"});
}

TEST_CASE("springs are checked against the plate, its supports and themselves") {
  CHECK(problems(spring("edges = [\"top\"]\ndeflection = 1\nrotation_normal = 2\nrotation_tangential = 3")).empty());
  CHECK(problems(spring("along = [[0.2, 0.2], [0.2, 0.8]]\ndeflection = 1")).empty());
  CHECK(problems(spring("position = [0.2, 0.2]\ndeflection = 1\nrotation = 1")).empty());
  expect(spring("deflection = 1"), ":18", "spring[0]", "none given, must be one of edges, along, position and cracks");
  expect(spring("position = [0, 0.5]\nedges = [\"top\"]\ndeflection = 1"), ":18", "spring[0]", "several given");
  expect(spring("edges = [\"top\"]"), ":18", "spring[0]", "resists nothing");
  expect(spring("edges = [\"top\"]\nrotation = 1"), ":18", "spring[0]", "rotation is of a spring at a position");
  expect(spring("position = [0, 0.5]\nrotation_normal = 1"), ":18", "spring[0]", "rotation_normal resists along edges");
  expect(spring("edges = [\"top\"]\ndeflection = -1"), ":20", "spring[0].deflection", "-1 given");
  expect(spring("edges = [\"tob\"]\ndeflection = 1"), ":19", "spring[0].edges", "did you mean 'top'?");
  expect(spring("edges = [\"left\"]\ndeflection = 1"), ":19", "spring[0].edges", "is held by support[0]");
  expect(spring("position = [0, 3]\ndeflection = 1"), ":19", "spring[0].position", "must lie in the plate");
  expect(spring("along = [[0, 0], [0, 3]]\ndeflection = 1"), ":19", "spring[0].along", "must lie in the plate");
  expect(spring("along = [[-0.2, 0], [0.2, 0]]\ndeflection = 1"), ":19", "spring[0].along", "lies along crack 0");
  const auto hinged =
      with_line(spring("edges = [\"left\"]\nrotation_normal = 1\ndeflection = 1"), 11, "kind = \"simply_supported\"");
  expect(hinged, ":19", "spring[0].edges", "leaves nothing for deflection to do");
}

TEST_CASE("all problems of foundations and springs come together, and what is read is written again") {
  CHECK(problems(foundation("modulus = -1\non = { circle = [7, 7, 1] }") +
                 "[[spring]]\nedges = [\"left\"]\ndeflection = 1\n[[spring]]\n")
            .size() == 4);  // modulus, patch, edge; the last is nowhere and resists nothing
  const auto file = read(foundation("modulus = 2\nshear = 3\non = { polygon = [[0, 0], [1, 0], [0, 1]] }") +
                         "[[spring]]\nposition = [0.1, 0.2]\ndeflection = 4\nrotation = 5\n");
  const auto again = read(cases::resolved_toml(file.content)).content;
  REQUIRE(again.foundations.size() == 1);
  REQUIRE(again.springs.size() == 1);
  CHECK(again.foundations[0].shear == 3);
  CHECK(again.foundations[0].patch.has_value());
  CHECK(again.springs[0].position == geometry::Point(0.1, 0.2));
  CHECK(again.springs[0].rotation == 5);
  CHECK(cases::resolved_toml(again) == cases::resolved_toml(file.content));
}

TEST_CASE("stiffeners are checked against the plate, its supports and themselves") {
  const auto stiffener = [](const std::string& lines) { return plain + "[[stiffener]]\n" + lines + "\n"; };
  CHECK(problems(stiffener("edges = [\"top\"]\nbending = 1\ntorsion = 2\nshear = 3\nmass = 4")).empty());
  expect(stiffener("bending = 1"), ":18", "stiffener[0]", "none given, must be one of edges and along");
  expect(stiffener("edges = [\"top\"]"), ":18", "stiffener[0]", "stiffens nothing");
  expect(stiffener("edges = [\"top\"]\ntorsion = 1\nshear = 2"), ":18", "stiffener[0]", "shear is of a beam");
  expect(stiffener("edges = [\"left\"]\nbending = 1"), ":19", "stiffener[0].edges", "clamped by support[0]");
  expect(stiffener("edges = [\"tob\"]\nbending = 1"), ":19", "stiffener[0].edges", "did you mean 'top'?");
  expect(stiffener("along = [[0, 0], [0, 3]]\nbending = 1"), ":19", "stiffener[0].along", "must lie in the plate");
  expect(stiffener("along = [[-0.2, 0], [0.2, 0]]\nbending = 1"), ":19", "stiffener[0].along", "lies along crack 0");
  expect(stiffener("edges = [\"top\"]\nbending = -1"), ":20", "stiffener[0].bending", "-1 given");
  expect(stiffener("edges = [\"top\"]\nbending = 1"), ":18", "stiffener", "bonds have theirs beside it",
         {"discretization.formulation=ordinary"});
  const auto file = read(stiffener("along = [[0, 0.2], [0, 0.8]]\nbending = 2\nmass = 3"));
  CHECK(read(cases::resolved_toml(file.content)).content.stiffeners[0].mass == 3);
}
