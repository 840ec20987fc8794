#include "plate/edges/oblique_edges.hpp"
#include "tests/catch.hpp"

using geometry::Point;

TEST_CASE("edge nodes: in the middle of equal parts, about a spacing long, the plate behind them") {
  const geometry::Outline triangle{{{{0, 0}, {4, 0}, {0, 3}}, {}}, {}};
  const auto nodes = plate::edge_nodes(triangle);
  REQUIRE(nodes.size() == 4 + 5 + 3);
  CHECK(nodes[0].at == Point(0.5, 0));
  CHECK(nodes[0].normal == Point(0, -1));
  CHECK((nodes[4].at - Point(3.6, 0.3)).norm() < 1e-15);
  CHECK((nodes[4].normal - Point(0.6, 0.8)).norm() < 1e-15);
  CHECK(nodes[11].normal == Point(-1, 0));
  for (const auto& node : nodes) CHECK(node.length == Approx(1));
}

TEST_CASE("edge nodes: short edges have one, round holes theirs with normals to the centre") {
  geometry::Outline plate{{{{0, 0}, {20, 0}, {20, 0.3}, {19.9, 20}, {0, 20}}, {}}, {}};
  plate.holes.push_back(geometry::Circle{{8, 9}, 2, "round"});
  double around = 0;
  int on_hole = 0;
  for (const auto& node : plate::edge_nodes(plate)) {
    around += node.length;
    const Point from = node.at - Point(8, 9);
    if (from.norm() > 3) continue;
    ++on_hole;
    CHECK((from / 2 + node.normal).norm() < 1e-15);
  }
  CHECK(on_hole == 13);
  CHECK(around == Approx(20 + 0.3 + std::hypot(0.1, 19.7) + 19.9 + 20 + 4 * 3.141592653589793));
}
