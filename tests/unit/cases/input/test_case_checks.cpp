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
         "kind = pinned, clamped or in_plane only");
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

TEST_CASE(
    "displacements in the plane along one direction need edges parallel to the axes, with bonds under such loads") {
  const std::vector<std::string> held{"support[0].in_plane=\"normal\"", "discretization.formulation=ordinary"};
  auto pulled = held;
  pulled.push_back("load=[{kind='edge_traction',edges=['edge1'],value=1}]");
  const std::string slanted = with_line(
      with_line(plain, 6, "outline = { polygon = [[-1, -1], [1, -1], [1, 1], [-0.9, 1]] }"), 12, "edges = [\"edge3\"]");
  expect(slanted, ":12", "support[0].edges", "parallel to x or y", pulled);
  CHECK(problems(slanted, held).empty());
  pulled.back() = "load=[{kind='edge_traction',edges=['right'],value=1}]";
  CHECK(problems(plain, pulled).empty());
}

TEST_CASE("what is missing or cannot be read is told once") {
  const auto told = [](const std::string& text) {
    std::size_t count = 0;
    for (const auto& problem : problems(text)) count += problem.key == "impact.velocity";
    return count;
  };
  const std::string moves =
      with_line(with_line(plain, 17, "kind = \"dynamic\"\nduration = 1.0"), 4, "thickness = 0.1\ndensity = 1.0");
  const std::string hit = moves + "[impact]\nposition = [0.5, 0.5]\nmass = 1.0\nstiffness = 1.0\n";
  CHECK(told(hit) == 1);
  CHECK(told(hit + "velocity = \"fast\"\n") == 1);
  CHECK(told(hit + "velocity = 0.0\n") == 1);
  CHECK(told(hit + "velocity = 1.0\n") == 0);
}
