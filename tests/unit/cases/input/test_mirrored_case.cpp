#include "cases/input/mirrored_case.hpp"

#include "tests/unit/cases/case_text.hpp"

using namespace case_text;

namespace {

/// Half of the plain plate: it has the edges `mirror` and others, which are clamped at the far end.
std::string half(const std::string& rectangle, const std::string& mirror, const std::string& far,
                 const std::string& crack, const std::string& more = "") {
  auto text = with_line(plain, 6, "outline = { rectangle = " + rectangle + " }");
  text = with_line(text, 7, "cracks = [" + crack + "]" + more);
  return text + "[[support]]\nkind = \"symmetry\"\nedges = [\"" + mirror +
         "\"]\n[[support]]\nkind = \"clamped\"\nedges = [\"" + far + "\"]\n";
}

}  // namespace

TEST_CASE("a crack on a symmetry edge lies between the plate and its image", "[mirror]") {
  struct Side {
    std::string rectangle, edge, far, crack;
    geometry::Polyline line;
  };
  // the left edge is clamped by the plain case: of the mirrored sides the upper and the lower one
  for (const auto& side : {Side{"[-1, 0, 1, 1]", "bottom", "right", "[[-0.3, 0], [0.3, 0]]", {{-0.3, 0}, {0.3, 0}}},
                           Side{"[-1, -1, 1, 0]", "top", "right", "[[0.2, 0], [1, 0]]", {{0.2, 0}, {1, 0}}}}) {
    CAPTURE(side.edge);
    const auto read_half = read(half(side.rectangle, side.edge, side.far, side.crack));
    const auto& content = read_half.content;
    const auto [low, high] = geometry::bounding_box(content.outline);
    CHECK((low == geometry::Point(-1, -1) && high == geometry::Point(1, 1)));
    CHECK(content.outline.outer.vertices.size() == 4);
    CHECK(geometry::errors(content.outline).empty());
    REQUIRE(content.cracks.size() == 1);
    CHECK(content.cracks[0] == side.line);
    REQUIRE(content.supports.size() == 2);
    for (const auto& support : content.supports) CHECK(support.kind == plate::SupportKind::clamped);
    REQUIRE(read_half.source.notes.size() == 1);
    CHECK_THAT(read_half.source.notes[0], Catch::Contains("computed with its image"));
    const auto resolved = cases::resolved_toml(content);
    CHECK(cases::resolved_toml(read(resolved).content) == resolved);
  }
}

TEST_CASE("holes and other cracks have images", "[mirror]") {
  const auto text = half("[-1, 0, 1, 1]", "bottom", "hole0", "[[-0.3, 0], [0.3, 0]], [[0.5, 0.5], [0.7, 0.7]]",
                         "\nholes = [{ circle = [-0.5, 0.5, 0.2] }]");
  const auto content = read(text).content;
  REQUIRE(content.outline.holes.size() == 2);
  CHECK(std::get<geometry::Circle>(content.outline.holes[1]).centre == geometry::Point(-0.5, -0.5));
  REQUIRE(content.cracks.size() == 3);
  CHECK(content.cracks[2] == geometry::Polyline{{0.5, -0.5}, {0.7, -0.7}});
  CHECK(content.supports.back().edges == std::vector<std::string>{"hole0", "hole1"});
}

TEST_CASE("what has no image beyond a crack on a symmetry edge is refused", "[mirror]") {
  const auto cracked = half("[-1, 0, 1, 1]", "bottom", "right", "[[-0.3, 0], [0.3, 0]]");
  expect(cracked + "[[load]]\nkind = \"point_force\"\nposition = [0.5, 0.5]\nvalue = 1\n", ":7", "geometry.cracks[0]",
         "these have no image beyond it here: load[1]");
  expect(cracked + "[[foundation]]\nmodulus = 1\non = { circle = [0, 0.5, 0.1] }\n", ":7", "geometry.cracks[0]",
         "foundation[0].on");
}
