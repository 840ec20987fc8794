#include "geometry/shape/crack_cleanup.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/catch.hpp"

using namespace geometry;

namespace {

Outline plate() {
  auto outline = rectangle(-2, -2, 2, 2);
  outline.holes.push_back(Circle{{1.5, 1.5}, 0.2, "hole0"});
  return outline;
}

std::vector<Point> tip_places(const std::vector<Polyline>& cracks) {
  std::vector<Point> result;
  for (const auto& tip : tips(crack_paths(plate(), cracks, tolerance(plate())))) result.push_back(tip.position);
  return result;
}

/// The straight crack from a to b with vertices at the shares given, cut there into pieces where wanted.
std::vector<Polyline> drawn(const Point& a, const Point& b, const std::vector<double>& shares, bool in_pieces,
                            std::mt19937& random) {
  std::vector<Polyline> result{{a}};
  for (const double share : shares) {
    const Point x = a + share * (b - a);
    result.back().push_back(x);
    if (in_pieces) result.push_back({x});
  }
  result.back().push_back(b);
  for (auto& piece : result)
    if (in_pieces && random() % 2 == 0) std::ranges::reverse(piece);
  std::ranges::shuffle(result, random);
  return result;
}

}  // namespace

TEST_CASE("merging: a straight crack is two points, however many vertices and pieces it was drawn with") {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> anywhere(-1.2, 1.2), share(0.02, 0.98);
  for (int n = 0; n < 400; ++n) {
    const Point a(anywhere(random), anywhere(random)), b(anywhere(random), anywhere(random));
    if ((b - a).norm() < 0.1) continue;
    std::vector<double> shares;
    for (int i = 0; i < 1 + n % 4; ++i) shares.push_back(share(random));
    std::ranges::sort(shares);
    bool apart = true;
    for (std::size_t i = 1; i < shares.size(); ++i) apart = apart && shares[i] - shares[i - 1] > 1e-3;
    if (!apart) continue;
    const auto given = drawn(a, b, shares, n % 2 == 0, random);
    const auto found = merged(plate(), given);
    REQUIRE(found.cracks.size() == 1);
    REQUIRE(found.cracks[0].size() == 2);
    CHECK(found.continuations.size() == given.size() - 1);
    CHECK(tip_places(found.cracks) == tip_places(given));  // in the same order
  }
}

TEST_CASE("merging: bends, branches, crossings and ends on the boundary stay") {
  const auto same = [](const std::vector<Polyline>& cracks) {
    const auto found = merged(plate(), cracks);
    return found.cracks == cracks && found.continuations.empty();
  };
  CHECK(same({{{-1, 0}, {0, 0}, {1, 0.001}}}));                  // a bend of 0.06 degrees
  CHECK(same({{{-1, 0}, {0, 0}}, {{0, 0}, {1, 0.5}}}));          // a kink in two pieces
  CHECK(same({{{-1, 0}, {0, 0}, {1, 0}}, {{0, 0}, {0.5, 1}}}));  // a branch at a vertex
  CHECK(same({{{-1, 0}, {0, 0}}, {{0, 0}, {1, 0}}, {{0, 0}, {0, 1}}}));
  CHECK(same({{{-1, 0}, {0, 0}}, {{0, 0}, {1, 0}}, {{0, -1}, {0, 1}}}));
  CHECK(same({{{-1, 0}, {-0.1, 0}}, {{0.1, 0}, {1, 0}}}));        // a ligament between
  CHECK(same({{{-1, 0}, {0, 0}}, {{0, 0}, {-0.5, 1e-6}}}));       // back along itself
  CHECK(same({{{-1, -1}, {1, -1}, {1, 0}, {-1, 0}, {-1, -1}}}));  // closed
}

TEST_CASE("merging: a closed crack is not opened, and is joined once") {
  const auto ring = merged(plate(), {{{0, 0}, {0.5, 0}, {0.5, 0.5}}, {{0.5, 0.5}, {0, 0.5}, {-0.5, 0}, {0, 0}}});
  REQUIRE(ring.cracks.size() == 1);
  CHECK(ring.cracks[0].front() == ring.cracks[0].back());
  CHECK(ring.cracks[0].size() == 5);  // the joint at the origin is left out or an end
  CHECK(ring.continuations.size() == 1);
}

TEST_CASE("merging: other cracks keep their order, a joined one has the place of its first piece") {
  const auto found =
      merged(plate(), {{{-1.5, -1}, {-1, -1}}, {{0, 0}, {0.5, 0}}, {{1, 1}, {1, 0.5}}, {{0, 0}, {-0.5, 0}}});
  REQUIRE(found.cracks.size() == 3);
  CHECK(found.cracks[1] == Polyline{{0.5, 0}, {-0.5, 0}});
  CHECK(found.cracks[2] == Polyline{{1, 1}, {1, 0.5}});
  CHECK(found.continuations[0].crack == 3);
  CHECK(found.continuations[0].onto == 1);
}

TEST_CASE("merging: coordinates rounded to five digits are on the line, an arc of small bends is not") {
  CHECK(merged(plate(), {{{-1, 0}, {-0.3333, 0.333333}, {1, 1}}}).cracks[0].size() == 2);
  Polyline arc;
  for (int i = 0; i <= 200; ++i) arc.emplace_back(std::cos(i * 0.005), std::sin(i * 0.005));
  const auto found = merged(plate(), {arc});
  CHECK(found.cracks[0].size() > 20);
  for (const auto& x : arc) CHECK(distance(found.cracks[0], x) < 1e-4);
}
