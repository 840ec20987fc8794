#include "plate/edges/lattice_body.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;

TEST_CASE("lattice body: nodes, fictitious nodes and surface nodes of bars, rectangles and boxes") {
  const auto bar = box_body({5}, 3), plane = box_body({4, 3}, 2), box = box_body({3, 2, 2}, 1);
  CHECK((bar.real == 5 && bar.fictitious() == 6 && bar.surface.size() == 2));
  CHECK((plane.real == 12 && plane.fictitious() == 8 * 7 - 12 && plane.surface.size() == 14));
  CHECK((box.real == 12 && box.fictitious() == 5 * 4 * 4 - 12 && box.surface.size() == 2 * (4 + 6 + 6)));
  CHECK(plane.node({1, 2, 0}) == 9);
  CHECK(plane.node({-2, -2, 0}) >= plane.real);
  CHECK(plane.node({-3, 0, 0}) == -1);
  CHECK(plane.surface_position(plane.surface_node(plane.node({3, 1, 0}), 0, 1)) == Eigen::Vector3d(3.5, 1, 0));
  CHECK(plane.surface_node(plane.node({1, 1, 0}), 0, 1) == -1);
}

TEST_CASE("lattice body: a re-entrant corner has faces on both sides") {
  std::vector<LatticeBody::Index> nodes;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < (y < 2 ? 4 : 2); ++x) nodes.push_back({x, y, 0});
  const auto body = lattice_body(2, nodes, 1, [](const LatticeBody::Index&, int, int) { return 0.5; });
  CHECK(body.surface.size() == 16);
  CHECK(body.surface_node(body.node({1, 2, 0}), 0, 1) >= 0);
  CHECK(body.surface_node(body.node({2, 1, 0}), 1, 1) >= 0);
  CHECK(body.node({2, 2, 0}) >= body.real);
}

TEST_CASE("lattice body: beyond a re-entrant corner a node is seen through the faces of either edge, elsewhere not") {
  std::vector<LatticeBody::Index> nodes;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < (y < 4 ? 10 : 4); ++x) nodes.push_back({x, y, 0});
  const auto body = lattice_body(2, nodes, 3, [](const LatticeBody::Index&, int, int) { return 0.5; });
  CHECK(body.sights.size() == 2 * 3 * 3);
  CHECK(body.values() == body.count() + 18);
  const int k = body.node({5, 6, 0});
  for (const int axis : {0, 1}) {
    const auto& [node, surface] = body.sights[std::size_t(body.value(k, axis) - body.count())];
    CHECK(node == k);
    CHECK(surface ==
          (axis == 0 ? body.surface_node(body.node({3, 6, 0}), 0, 1) : body.surface_node(body.node({5, 3, 0}), 1, 1)));
  }
  for (const LatticeBody::Index& other : {LatticeBody::Index(7, 4, 0), {4, 7, 0}, {-1, -1, 0}, {2, 2, 0}})
    for (const int axis : {0, 1}) CHECK(body.value(body.node(other), axis) == body.node(other));
  CHECK(box_body({5, 4}, 3).sights.empty());
}

TEST_CASE("lattice body: what is not one is refused") {
  const auto at = [](double d) { return [d](const LatticeBody::Index&, int, int) { return d; }; };
  CHECK_THROWS_AS(lattice_body(2, {}, 1, at(0.5)), std::invalid_argument);
  CHECK_THROWS_AS(lattice_body(4, {{0, 0, 0}}, 1, at(0.5)), std::invalid_argument);
  CHECK_THROWS_AS(lattice_body(2, {{0, 0, 0}}, 1, at(0)), std::invalid_argument);
  CHECK_THROWS_AS(lattice_body(2, {{0, 0, 0}}, 1, at(1)), std::invalid_argument);
}
