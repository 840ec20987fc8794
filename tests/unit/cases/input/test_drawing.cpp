#include "cases/input/drawing.hpp"

#include <algorithm>
#include <numbers>
#include <random>

#include "geometry/shape/smooth_curve.hpp"
#include "tests/catch.hpp"

using geometry::Point;
using geometry::Polyline;

namespace {

cases::DrawnPiece straight(const std::string& layer, const Point& a, const Point& b) {
  return {{a, b}, {}, layer, 1};
}

cases::DrawnPiece arc(const std::string& layer, const Point& centre, double radius, double from, double to) {
  constexpr double degree = std::numbers::pi / 180;
  return {geometry::arc(centre, radius, degree * from, degree * to), geometry::Circle{centre, radius, ""}, layer, 1};
}

std::vector<cases::DrawnPiece> ring(const std::string& layer, const Polyline& corners) {
  std::vector<cases::DrawnPiece> result;
  for (std::size_t i = 0; i < corners.size(); ++i)
    result.push_back(straight(layer, corners[i], corners[(i + 1) % corners.size()]));
  return result;
}

/// Pieces in another order, half of them the other way round.
std::vector<cases::DrawnPiece> shuffled(std::vector<cases::DrawnPiece> pieces, unsigned int seed) {
  std::mt19937 random(seed);
  std::shuffle(pieces.begin(), pieces.end(), random);
  for (std::size_t i = 0; i < pieces.size(); i += 2) std::ranges::reverse(pieces[i].points);
  return pieces;
}

const Polyline square{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
const Polyline bent{{0, 0}, {4, 0}, {4, 3}, {2, 3}, {2, 4}, {0, 4}};

}  // namespace

TEST_CASE("lines in any order and direction are one outline", "[drawing]") {
  for (unsigned int seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const auto of_square = cases::joined(shuffled(ring("outline", square), seed), {}, 1e-6, 0);
    CHECK(of_square.problems.empty());
    CHECK(of_square.outline.outer.vertices == geometry::rectangle(0, 0, 4, 3).outer.vertices);
    CHECK(of_square.outline.outer.edge_names == geometry::rectangle(0, 0, 4, 3).outer.edge_names);
    const auto of_bent = cases::joined(shuffled(ring("outline", bent), seed), {}, 1e-6, 0);
    CHECK(of_bent.outline.outer.vertices == bent);
    CHECK(of_bent.outline.outer.edge_names ==
          std::vector<std::string>{"edge0", "edge1", "edge2", "edge3", "edge4", "edge5"});
  }
}

TEST_CASE("layers of edges name them", "[drawing]") {
  auto pieces = ring("outline", square);
  pieces[1].layer = "fixed", pieces[3].layer = "fixed";
  cases::DrawingLayers layers;
  layers.edges = {"Fixed"};
  const auto found = cases::joined(pieces, layers, 1e-6, 0);
  CHECK(found.outline.outer.edge_names == std::vector<std::string>{"edge0", "Fixed", "edge1", "Fixed"});
  CHECK(layers.all() == std::set<std::string>{"outline", "holes", "cracks", "fixed"});
}

TEST_CASE("gaps up to the tolerance are joined, others told with their place", "[drawing]") {
  auto pieces = ring("outline", bent);
  pieces[2].points.back() += Point(0.01, 0);
  CHECK(cases::joined(pieces, {}, 0.02, 0).problems.empty());
  const auto open = cases::joined(pieces, {}, 0.001, 0);
  REQUIRE(open.problems.size() == 2);
  CHECK_THAT(open.problems[0], Catch::Contains("layer outline is open at [2.01, 3]") && Catch::Contains("0.01 away"));
  CHECK(open.outline.outer.vertices.empty());
  pieces = ring("outline", square);
  pieces.push_back(pieces[0]);
  CHECK_THAT(cases::joined(pieces, {}, 1e-6, 0).problems.at(0), Catch::Contains("3 lines meet at [0, 0]"));
}

TEST_CASE("circles of one or several arcs stay circles, other holes are chords", "[drawing]") {
  auto pieces = ring("outline", square);
  pieces.push_back(arc("holes", {1, 1}, 0.5, 0, 360));
  pieces.back().points.back() = pieces.back().points.front();
  pieces.push_back(arc("holes", {3, 2}, 0.25, 30, 200));
  pieces.push_back(arc("holes", {3, 2}, 0.25, 200, 390));
  pieces.push_back(arc("holes", {2.2, 2}, 0.25, 0, 180));
  pieces.push_back(straight("holes", {1.95, 2}, {2.45, 2}));
  const auto found = cases::joined(pieces, {}, 1e-6, 0.1);
  CHECK(found.problems.empty());
  REQUIRE(found.outline.holes.size() == 3);
  int circles = 0;
  for (const auto& circle : geometry::circles(found.outline)) circles += circle.radius == 0.5 || circle.radius == 0.25;
  CHECK(circles == 2);
  for (const auto& hole : found.outline.holes)
    if (const auto* half = std::get_if<geometry::Polygon>(&hole)) {
      CHECK(half->vertices.size() == 13);  // 180 degrees by chords of at most 15, and the line
      for (const Point& x : half->vertices) CHECK((x - Point(2.2, 2)).norm() == Approx(0.25));
    }
  CHECK(found.off == Approx(0.25 * (1 - std::cos(std::numbers::pi / 24))).epsilon(0.02));
}

TEST_CASE("chords of curves are as long as they are wanted", "[drawing]") {
  for (const double chord : {0.02, 0.05, 0.11}) {
    CAPTURE(chord);
    std::vector<cases::DrawnPiece> pieces{arc("outline", {0, 0}, 1, 0, 360)};
    pieces.back().points.back() = pieces.back().points.front();
    const auto found = cases::joined(pieces, {}, 1e-6, chord);
    const auto& ring = found.outline.outer.vertices;
    CHECK(ring.size() == std::size_t(std::ceil(2 * std::numbers::pi / chord)));
    for (std::size_t i = 0; i < ring.size(); ++i) {
      CHECK(ring[i].norm() == Approx(1));
      CHECK((ring[(i + 1) % ring.size()] - ring[i]).norm() == Approx(chord).epsilon(0.15));
    }
    CHECK(found.off < chord * chord / 6);
    for (const auto& name : found.outline.outer.edge_names) CHECK(name == "edge0");
  }
}

TEST_CASE("shapes that cannot be are told by layer and place", "[drawing]") {
  auto pieces = ring("outline", square);
  const auto crossing = ring("holes", {{3, 1}, {5, 1}, {5, 2}, {3, 2}});
  pieces.insert(pieces.end(), crossing.begin(), crossing.end());
  const auto crossed = cases::joined(pieces, {}, 1e-6, 0);
  REQUIRE_FALSE(crossed.problems.empty());
  CHECK_THAT(crossed.problems[0], Catch::Contains("layer holes, holes[0] at [3, 1],"));
  pieces = ring("outline", square);
  const auto second = ring("outline", {{1, 1}, {2, 1}, {2, 2}});
  pieces.insert(pieces.end(), second.begin(), second.end());
  CHECK_THAT(cases::joined(pieces, {}, 1e-6, 0).problems.at(0),
             Catch::Contains("2 closed loops, at [0, 0] and [1, 1]"));
  CHECK_THAT(cases::joined(ring("outline", {{0, 0}, {2, 2}, {2, 0}, {0, 1}}), {}, 1e-6, 0).problems.at(0),
             Catch::Contains("layer outline"));
}

TEST_CASE("cracks go on through ends that meet, and end where three do", "[drawing]") {
  auto pieces = ring("outline", square);
  const auto add = [&](const Point& a, const Point& b) { pieces.push_back(straight("cracks", a, b)); };
  add({1, 1}, {2, 1}), add({2.5, 1.5}, {2, 1}), add({3, 2}, {3.5, 2}), add({3.5, 2}, {3.5, 2.5}),
      add({3.5, 2}, {3.8, 2});
  const auto found = cases::joined(pieces, {}, 1e-6, 0);
  CHECK(found.problems.empty());
  REQUIRE(found.cracks.size() == 4);
  CHECK(std::ranges::count(found.cracks, Polyline{{1, 1}, {2, 1}, {2.5, 1.5}}) == 1);
}

TEST_CASE("a crack from a curved edge ends on the chord", "[drawing]") {
  for (const double angle : {0.3, 1.0, 2.2, 4.0}) {
    CAPTURE(angle);
    std::vector<cases::DrawnPiece> pieces{arc("outline", {0, 0}, 1, 0, 360)};
    pieces.back().points.back() = pieces.back().points.front();
    const Point out(std::cos(angle), std::sin(angle));
    pieces.push_back(straight("cracks", out, 0.5 * out));
    const auto found = cases::joined(pieces, {}, 1e-6, 0.1);
    CHECK(found.problems.empty());
    const auto paths = geometry::crack_paths(found.outline, found.cracks, geometry::tolerance(found.outline));
    REQUIRE(paths.size() == 1);
    CHECK(geometry::tips(paths).size() == 1);
  }
}
