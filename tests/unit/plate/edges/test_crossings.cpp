#include "plate/edges/lattice_body.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/edges/edge_bodies.hpp"

using namespace edge_bodies;

namespace {

double total(const std::vector<Crossing>& crossings) {
  double sum = 0;
  for (const auto& one : crossings) sum += one.share;
  return sum;
}

/// The part of a bond that the face of a node has.
double share_of(const LatticeBody& b, const std::vector<Crossing>& crossings, const LatticeBody::Index& node,
                int axis) {
  double sum = 0;
  for (const auto& one : crossings)
    if (one.surface == b.surface_node(b.node(node), axis, -1)) sum += one.share;
  return sum;
}

}  // namespace

TEST_CASE("crossings: a whole, a half, a quarter where a bond crosses a face, an edge, a vertex of faces (Sca23 35)") {
  const auto b = box_body({4, 4, 4}, 3);
  const auto cut = [&](const LatticeBody::Index& from, const LatticeBody::Index& to) {
    return crossings(b, b.node(from), b.node(to), FluxRule::crossing_point);
  };
  CHECK(share_of(b, cut({0, 1, 1}, {-1, 1, 1}), {0, 1, 1}, 0) == 1);
  CHECK(share_of(b, cut({1, 1, 1}, {-2, 2, 1}), {0, 1, 1}, 0) == 0.5);
  CHECK(share_of(b, cut({0, 1, 1}, {-1, 2, 1}), {0, 1, 1}, 0) == 0.5);
  CHECK(share_of(b, cut({0, 1, 1}, {-1, 2, 1}), {0, 2, 1}, 0) == 0.5);
  for (const int y : {1, 2})
    for (const int z : {1, 2}) CHECK(share_of(b, cut({0, 1, 1}, {-1, 2, 2}), {0, y, z}, 0) == 0.25);
  CHECK(share_of(b, cut({0, 1, 1}, {-2, 2, 1}), {0, 1, 1}, 0) == 1);
  CHECK(cut({-1, 1, 1}, {0, 1, 1}).empty());
  CHECK(cut({1, 1, 1}, {0, 2, 1}).empty());
  CHECK(cut({1, 1, 1}, {-2, 1, 1}).front().cut == Approx(0.5).epsilon(1e-15));
}

TEST_CASE("crossings: lever rule: to the outer node's column as much as lies inside, to the inner node's the rest") {
  const auto b = box_body({6, 6}, 3);
  const auto cut = crossings(b, b.node({0, 2, 0}), b.node({-2, 3, 0}), FluxRule::lever);
  CHECK(share_of(b, cut, {0, 2, 0}, 0) == Approx(0.75).epsilon(1e-15));
  CHECK(share_of(b, cut, {0, 3, 0}, 0) == Approx(0.25).epsilon(1e-15));
  CHECK(total(crossings(b, b.node({1, 2, 0}), b.node({-2, 2, 0}), FluxRule::lever)) == 1);
}

TEST_CASE("crossings: both rules put a bond's force where it crosses, on the mean") {
  const auto b = box_body({9, 9}, 3);
  for (const auto rule : {FluxRule::crossing_point, FluxRule::lever})
    for (int across = -3; across <= 3; ++across)
      for (int depth = 0; depth < 3; ++depth) {
        const int from = b.node({depth, 4, 0}), to = b.node({depth - 3, 4 + across, 0});
        double at = 0, cut_at = 0;
        for (const auto& one : crossings(b, from, to, rule)) {
          at += one.share * b.surface_position(one.surface)[1];
          cut_at = 4 + one.cut * across;
        }
        CHECK(total(crossings(b, from, to, rule)) == Approx(1).epsilon(1e-14));
        CHECK(std::abs(at - cut_at) <= (rule == FluxRule::lever ? 1e-12 : 0.5));
      }
}

TEST_CASE("crossings: bonds between fictitious nodes count, parts beyond the edge are dropped") {
  const auto b = box_body({5, 5}, 3);
  const int inner = b.node({1, -1, 0}), outer = b.node({-1, 1, 0});
  REQUIRE(inner >= b.real);
  REQUIRE(outer >= b.real);
  CHECK(share_of(b, crossings(b, inner, outer, FluxRule::crossing_point), {0, 0, 0}, 0) == 0.5);
  CHECK(share_of(b, crossings(b, inner, outer, FluxRule::lever), {0, 1, 0}, 0) == Approx(0.75).epsilon(1e-15));
  CHECK(total(crossings(b, inner, outer, FluxRule::lever)) == Approx(0.75).epsilon(1e-15));
}
