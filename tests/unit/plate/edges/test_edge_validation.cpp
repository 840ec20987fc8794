#include "plate/edges/surface_layout.hpp"

#include "plate/model/errors.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

const std::vector<std::string> all_edges{"left", "right", "bottom", "top"};

/// A square of 2, 0.4 thick, clamped; horizon 0.3015.
Problem validated_square(SupportKind kind = SupportKind::clamped) {
  Problem p;
  p.section = {1000, 0.3, 0.4};
  p.outline = geometry::rectangle(-1, -1, 1, 1);
  p.discretization.spacing = 0.1;
  p.supports = {{kind, all_edges, {}}};
  return p;
}

/// What it is refused for; nothing where it is not.
std::optional<Subject> refused_subject(const Problem& p, EdgeMethod method = EdgeMethod::surface_nodes,
                                       const std::vector<geometry::CrackPath>& cracks = {}) {
  try {
    check(p, cracks, method);
  } catch (const Refused& why) {
    CHECK(why.reasons().size() == 1);
    return why.reasons().front().subject;
  }
  return {};
}

}  // namespace

TEST_CASE("acceptance: squares are served, oblique edges by surface nodes alone") {
  auto p = validated_square();
  CHECK(!refused_subject(p));
  CHECK(!refused_subject(p, EdgeMethod::fictitious_nodes));
  p.outline.outer.vertices[2] = {1, 1.3};
  CHECK(!refused_subject(p));
  CHECK(refused_subject(p, EdgeMethod::fictitious_nodes) == Subject::geometry);
  p = validated_square();
  p.outline.holes.push_back(geometry::Circle{{0, 0}, 0.31, "round"});
  CHECK(!refused_subject(p));
  std::get<geometry::Circle>(p.outline.holes[0]).radius = 0.29;  // not two horizons wide
  CHECK(refused_subject(p) == Subject::geometry);
}

TEST_CASE("acceptance: edges shorter than a horizon between corners, and than half a spacing, are refused") {
  auto p = validated_square();
  p.outline.outer = {{{-1, -1}, {1, -1}, {1, 0.8}, {0.8, 0.8}, {0.8, 1}, {-1, 1}}, {}};
  CHECK(refused_subject(p) == Subject::geometry);
  p.outline.outer = {{{-1, -1}, {1, -1}, {1, 0.6}, {0.6, 1}, {-1, 1}}, {}};
  CHECK(!refused_subject(p));
  p.outline.outer = {{{-1, -1}, {1, -1}, {1, 0.8}, {0.8, 1}, {-1, 1}}, {}};
  CHECK(refused_subject(p) == Subject::geometry);  // 0.28 between corners of 45 degrees
  p.outline.outer = {{{-1, -1}, {1, -1}, {1.02, -0.96}, {1.02, 1}, {-1, 1}}, {}};
  CHECK(refused_subject(p) == Subject::geometry);  // 0.045
}

TEST_CASE("acceptance: symmetry and loads on edges are refused where an edge is oblique") {
  auto p = validated_square(SupportKind::symmetry);
  CHECK(!refused_subject(p));
  p.outline.outer.vertices[2] = {1, 1.3};
  CHECK(refused_subject(p) == Subject::support);
  p = validated_square(SupportKind::simply_supported);
  p.loads = {Load{EdgeShear{.edges = {"left"}, .value = 1}}};
  CHECK(!refused_subject(p));
  p.outline.outer.vertices[2] = {1, 1.3};
  CHECK(refused_subject(p) == Subject::load_edges);
}

TEST_CASE("acceptance: cracks stay more than a horizon from the edges") {
  const auto crack = [](double end) {
    return std::vector<geometry::CrackPath>{{{{-0.2, 0}, {end, 0}}, geometry::End::tip, geometry::End::tip}};
  };
  CHECK(!refused_subject(validated_square(), EdgeMethod::surface_nodes, crack(0.69)));
  CHECK(refused_subject(validated_square(), EdgeMethod::surface_nodes, crack(0.71)) == Subject::cracks);
}

TEST_CASE("acceptance: the horizon over the thickness has limits by method, supports and direction of the edges") {
  const auto served = [](double thickness, SupportKind kind, EdgeMethod method, bool oblique) {
    auto p = validated_square(kind);
    p.section.thickness = thickness;
    if (oblique) p.outline.outer.vertices[2] = {1, 1.3};
    return !refused_subject(p, method);
  };
  using enum SupportKind;
  const auto nodes = EdgeMethod::surface_nodes, fictitious = EdgeMethod::fictitious_nodes;
  struct Row {
    SupportKind kind;
    EdgeMethod method;
    bool oblique;
    double most;  // horizon / thickness
  };
  for (const auto& [kind, method, oblique, most] :
       {Row{clamped, nodes, false, 3.1}, Row{clamped, nodes, true, 3.1}, Row{simply_supported_hard, nodes, true, 3.1},
        Row{simply_supported, nodes, false, 2.1}, Row{simply_supported, nodes, true, 2.1}, Row{free, nodes, false, 2.1},
        Row{free, nodes, true, 1}, Row{symmetry, nodes, false, 2.1}, Row{symmetry, fictitious, false, 3.1},
        Row{clamped, fictitious, false, 3.1}}) {
    CAPTURE(int(kind), int(method), oblique);
    CHECK(served(0.3015 / (0.99 * most), kind, method, oblique));
    CHECK(!served(0.3015 / (1.01 * most), kind, method, oblique));
  }
  CHECK(!served(0.42, simply_supported, fictitious, false));  // 0.151 of the side, 0.101 at most
}
