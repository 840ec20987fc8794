#include "plate/formulation/boundary.hpp"
#include "tests/catch.hpp"

using namespace plate;
using geometry::Point;

namespace {

/// Two edges along the lattice (one of them between points), one oblique, a hole that is round.
std::vector<Side> sides() {
  geometry::Outline outline{{{{0, 0}, {6, 0}, {6, 4.5}, {1, 4.5}}, {"south", "east", "north", "slope"}}, {}};
  outline.holes.push_back(geometry::Circle{{3.5, 2}, 0.75, "hole"});
  return sides_of(outline, {{SupportKind::clamped, {"south", "hole"}, {}}, {SupportKind::symmetry, {"north"}, {}}});
}

const std::vector<Point> inner{{2, 0.5}, {5.5, 4}, {2, 4}, {3.5, 1}, {4.5, 2.25}};  // of the plate

}  // namespace

TEST_CASE("side: the plate is inside of every side, and outward leads out by the shortest way") {
  for (const auto& side : sides()) {
    INFO(side.name);
    for (const auto& u : inner) {
      const double depth = side.inside(u);
      CHECK(depth > 0);
      CHECK(side.outward(u).norm() == Approx(1));
      CHECK(side.inside(u + depth * side.outward(u)) == Approx(0).margin(1e-14));
      CHECK(side.inside(u + (depth + 0.1) * side.outward(u)) == Approx(-0.1));
    }
  }
}

TEST_CASE("side: mirrored at an edge along an axis, twice is where it was") {
  for (const auto& side : sides()) {
    if (side.normal_axis() < 0) continue;
    for (const auto& u : inner) {
      const Point image = side.mirrored(u);
      CHECK(side.inside(image) == Approx(-side.inside(u)));
      CHECK((image - u).norm() == Approx(2 * side.inside(u)));
      CHECK((side.mirrored(image) - u).norm() < 1e-14);
    }
  }
}

TEST_CASE("side: which ones have images that are lattice points") {
  std::vector<int> axes;
  std::vector<bool> along;
  std::vector<SupportKind> kinds;
  for (const auto& side : sides())
    axes.push_back(side.normal_axis()), along.push_back(side.along_lattice()), kinds.push_back(side.kind);
  CHECK(axes == std::vector<int>{1, 0, 1, -1, -1});
  CHECK(along == std::vector<bool>{true, true, false, false, false});  // north lies on a row of points
  using enum SupportKind;
  CHECK(kinds == std::vector<SupportKind>{clamped, free, symmetry, free, clamped});
}

TEST_CASE("holders: every edge that is held once, pins in their order, what is free not at all") {
  using enum SupportKind;
  const auto holders = holders_of({{free, {"west"}, {}},
                                   {pinned, {}, {{1, 2}, {3, 4}}},
                                   {clamped, {"south", "south"}, {}},
                                   {pinned, {}, {{5, 6}}}});
  std::vector<std::string> names;
  for (const auto& one : holders) names.push_back(one.name);
  CHECK(names == std::vector<std::string>{"pin0", "pin1", "south", "pin2"});
  CHECK(*holders[3].position == Point(5, 6));
  CHECK(holder(holders, "south") == 2);
  CHECK(holder(holders, "pin0") == holders.size());  // an edge of that name is no pin
}
