#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/lattice/cloud.hpp"
#include "geometry/shape/crack_path.hpp"
#include "tests/catch.hpp"

using namespace geometry;

namespace {

CrackPath free_crack(Polyline vertices) {
  return {std::move(vertices), End::tip, End::tip};
}

Point turned(const Point& x) {
  return {-x.y(), x.x()};
}

/// Lattice points of [0, 10)^2 and the bonds of one of them within 3 spacings.
std::vector<Point> points() {
  std::vector<Point> all;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) all.emplace_back(i + 0.5, j + 0.5);
  return all;
}

int kept_bonds(const CrackPath& crack, const Point& p) {
  int kept = 0;
  for (const Point& q : points())
    if (q != p && (q - p).norm() <= 3 && !separates(crack, p, q)) ++kept;
  return kept;
}

/// Sign of the cross product in integers: a reference that cannot round. Coordinates are multiples of 1/2.
long turn(const Point& a, const Point& b, const Point& c) {
  const auto twice = [](double u) { return std::lround(2 * u); };
  return (twice(b.x()) - twice(a.x())) * (twice(c.y()) - twice(a.y())) -
         (twice(b.y()) - twice(a.y())) * (twice(c.x()) - twice(a.x()));
}

bool collinear(const Point& p, const Point& q, const Point& v) {
  return (p.x() - q.x()) * (v.y() - q.y()) == (p.y() - q.y()) * (v.x() - q.x());
}

}  // namespace

TEST_CASE("severs: a bond that touches a tip stays, one behind it is cut, one ahead is not") {
  const CrackPath crack = free_crack({{2, 5}, {6.5, 5}});
  CHECK_FALSE(separates(crack, {6.5, 4.5}, {6.5, 5.5}));
  CHECK_FALSE(separates(crack, {5.5, 4.5}, {7.5, 5.5}));
  CHECK(separates(crack, {5.5, 4.5}, {6.5, 5.5}));
  CHECK_FALSE(separates(crack, {6.5, 4.5}, {7.5, 5.5}));
  CHECK_FALSE(separates(crack, {6.5, 5}, {4.5, 3.5}));  // a point that is the tip
}

TEST_CASE("severs: points on a horizontal, vertical or oblique crack lie on the stated side") {
  struct Line {
    Polyline vertices;
    Point on, stated, other;
  };
  const std::vector<Line> lines{{{{1, 4.5}, {9, 4.5}}, {4.5, 4.5}, {4.5, 5.5}, {4.5, 3.5}},
                                {{{4.5, 1}, {4.5, 9}}, {4.5, 4.5}, {5.5, 4.5}, {3.5, 4.5}},
                                {{{1, 1}, {9, 9}}, {4.5, 4.5}, {5.5, 4.5}, {3.5, 4.5}},
                                {{{1, 8}, {8, 1}}, {4.5, 4.5}, {5.5, 4.5}, {3.5, 4.5}}};
  for (Line line : lines)
    for (int reversed = 0; reversed < 2; ++reversed) {
      const CrackPath crack = free_crack(line.vertices);
      CHECK_FALSE(separates(crack, line.on, line.stated));
      CHECK(separates(crack, line.on, line.other));
      CHECK(separates(crack, line.other, line.on));
      std::reverse(line.vertices.begin(), line.vertices.end());
    }
}

TEST_CASE("severs: points on a crack through a whole row stay bonded along it") {
  const CrackPath crack{{{0, 4.5}, {10, 4.5}}, End::mouth, End::mouth};
  for (const Point& p : points()) CHECK(kept_bonds(crack, p) >= 8);
  CHECK_FALSE(separates(crack, {3.5, 4.5}, {4.5, 4.5}));
}

TEST_CASE("severs: open bonds agree with integer arithmetic, whichever way crack and bond run") {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> half(0, 19);
  const auto draw = [&] { return Point(0.5 * half(random), 0.5 * half(random)); };
  int decided = 0, cut = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Point a = draw(), b = draw(), p = draw(), q = draw();
    if (a == b || p == q) continue;
    const CrackPath crack = free_crack({a, b});
    const bool separated = separates(crack, p, q);
    REQUIRE(separated == separates(crack, q, p));
    REQUIRE(separated == separates(free_crack({b, a}), p, q));
    const double of_line = static_cast<double>(turn(a, b, p)) * static_cast<double>(turn(a, b, q));
    const double of_bond = static_cast<double>(turn(p, q, a)) * static_cast<double>(turn(p, q, b));
    if (of_line == 0 || of_bond == 0) continue;
    REQUIRE(separated == (of_line < 0 && of_bond < 0));
    ++decided;
    cut += separated;
  }
  CHECK(decided > 10000);
  CHECK(cut > 1000);
}

TEST_CASE("severs: degenerate contacts are those of points really moved by a small (e, e^2)") {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> half(0, 7);
  const auto draw = [&] { return Point(0.5 * half(random), 0.5 * half(random)); };
  const Point shift(std::ldexp(1.0, -12), std::ldexp(1.0, -24));
  int touching = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Point a = draw(), b = draw(), c = draw(), p = draw(), q = draw();
    if (a == b || b == c || p == q) continue;
    if (turn(p, q, a) == 0 || turn(p, q, c) == 0) continue;  // tips follow their own rule
    const CrackPath crack = free_crack({a, b, c});
    const bool degenerate = turn(a, b, p) == 0 || turn(a, b, q) == 0 || turn(p, q, b) == 0;
    if (!degenerate) continue;
    REQUIRE(separates(crack, p, q) == separates(crack, p + shift, q + shift));
    REQUIRE(separates(crack, p, q) == separates(free_crack({c, b, a}), p, q));
    ++touching;
  }
  CHECK(touching > 1000);
}

TEST_CASE("severs: a bond exactly through a kink is cut where the crack goes on, not where it turns back") {
  const CrackPath bent = free_crack({{1, 1}, {4, 4}, {9, 4}});
  CHECK(separates(bent, {3.5, 5.5}, {4.5, 2.5}));
  CHECK(separates(bent, {4, 5.5}, {4, 2.5}));
  const CrackPath wedge = free_crack({{1, 6}, {4, 4}, {1, 2}});  // its point touches the bond from the left
  CHECK_FALSE(separates(wedge, {4, 2.5}, {4, 5.5}));             // the bond is moved to +x, off the wedge
  CHECK(separates(wedge, {3.5, 2.5}, {3.5, 5.5}));               // crosses both legs
}

TEST_CASE("severs: turning crack and bond by a right angle changes nothing where only the tips are touched") {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> cell(0, 9);
  const Polyline path{{1.25, 3}, {4.5, 5.5}, {8, 5.5}};
  Polyline turned_path;
  for (const Point& v : path) turned_path.push_back(turned(v));
  int tested = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Point p(cell(random) + 0.5, cell(random) + 0.25), q(cell(random) + 0.5, cell(random) + 0.25);
    if (p == q || collinear(p, q, {4.5, 5.5})) continue;  // through the kink
    REQUIRE(separates(free_crack(path), p, q) == separates(free_crack(turned_path), turned(p), turned(q)));
    ++tested;
  }
  CHECK(tested > 2000);
}

TEST_CASE("severs: mouths and junctions are closed ends") {
  const CrackPath closed{{{4, 0}, {4, 5}}, End::mouth, End::junction};
  CHECK(separates(closed, {3.5, 4.5}, {4.5, 5.5}));  // through (4, 5)
  CHECK(separates(closed, {3.5, 0}, {4.5, 0}));
  CHECK_FALSE(separates(free_crack({{4, 0}, {4, 5}}), {3.5, 4.5}, {4.5, 5.5}));
  const CrackPath slant{{{0.5, 0.5}, {4.5, 5.5}}, End::tip, End::junction};  // points on it keep to one side
  CHECK(separates(slant, {4.5, 5.5}, {3.5, 5.5}) != separates(slant, {4.5, 5.5}, {5.5, 5.5}));
}

TEST_CASE("two crossing cracks cut the bonds of each, and a T-junction is closed") {
  const Outline plate = rectangle(0, 0, 10, 10);
  const auto cross = crack_paths(plate, {{{2, 5}, {8, 5}}, {{5, 2}, {5, 8}}}, 1e-9);
  for (const CrackPath& path : cross) {
    CHECK(path.front == End::tip);
    CHECK(path.back == End::tip);
  }
  CHECK(separates(cross[0], {4.5, 4.5}, {4.5, 5.5}));
  CHECK(separates(cross[1], {4.5, 4.5}, {5.5, 4.5}));
  CHECK(separates(cross[0], {4.5, 4.5}, {5.5, 5.5}));  // through the crossing
  const auto tee = crack_paths(plate, {{{2, 5}, {8, 5}}, {{5, 5}, {5, 10}}}, 1e-9);
  CHECK(tee[1].front == End::junction);
  CHECK(tee[1].back == End::mouth);
  const auto cut = [&](const Point& p, const Point& q) { return separates(tee[0], p, q) || separates(tee[1], p, q); };
  CHECK(cut({4.5, 5.5}, {5.5, 5.5}));
  CHECK(cut({4.5, 5}, {5.5, 5}));  // along the first crack, through the junction
  CHECK(cut({4.5, 4.5}, {5.5, 5.5}));
}

TEST_CASE("decimal noise: the tip at 0.3 lies on a column of points of spacing 0.008") {
  const Outline plate = rectangle(-1, -1, 1, 1);
  const LatticeUnits units{{-1, -1}, 0.008};
  const auto crack = to_lattice(crack_paths(plate, {{{-0.3, 0}, {0.3, 0}}}, 1e-9), units).at(0);
  CHECK(crack.vertices[1] == Point(162.5, 125));
  CHECK(crack.vertices[0] == Point(87.5, 125));
  for (int reach = 1; reach <= 3; ++reach) {
    CHECK_FALSE(separates(crack, {162.5, 125.5 - reach}, {162.5, 124.5 + reach}));
    CHECK(separates(crack, {161.5, 125.5 - reach}, {161.5, 124.5 + reach}));
    CHECK_FALSE(separates(crack, {87.5, 125.5 - reach}, {87.5, 124.5 + reach}));
  }
}

TEST_CASE("crack_paths classifies ends within the tolerance, tips point straight ahead") {
  Outline plate = rectangle(0, 0, 10, 10);
  plate.holes.push_back(Circle{{5, 5}, 1, "hole0"});
  const auto paths = crack_paths(plate, {{{6 + 1e-10, 5}, {8, 5}, {8, 7}}, {{0, 2}, {3, 2}}, {{3, 2}, {3, 1}}}, 1e-9);
  CHECK(paths[0].front == End::mouth);
  CHECK(paths[0].back == End::tip);
  CHECK(paths[1].front == End::mouth);
  CHECK(paths[1].back == End::junction);
  CHECK(paths[2].front == End::junction);
  CHECK(paths[2].back == End::tip);
  const auto all = tips(paths);
  REQUIRE(all.size() == 2);
  CHECK((all[0].direction - Point(0, 1)).norm() < 1e-15);
  CHECK(all[0].position == Point(8, 7));
  CHECK((all[0].crack == 0 && all[0].at_back));
  CHECK((all[1].direction - Point(0, -1)).norm() < 1e-15);
  CHECK(all[1].crack == 2);
  const auto own = crack_paths(plate, {{{1, 8}, {4, 8}, {4, 9}, {2, 9}, {2, 8}}}, 1e-9);
  CHECK(own[0].front == End::tip);
  CHECK(own[0].back == End::junction);
  const auto both = tips(crack_paths(rectangle(0, 0, 9, 9), {{{2, 2}, {5, 6}}}, 1e-9));
  REQUIRE(both.size() == 2);
  CHECK_FALSE(both[0].at_back);
  CHECK((both[0].direction - Point(-0.6, -0.8)).norm() < 1e-15);
}

TEST_CASE("faults of cracks say what is wrong and where") {
  Outline plate = rectangle(-1, -1, 1, 1);
  plate.holes.push_back(Circle{{0.5, 0.5}, 0.25, "hole0"});
  const auto only = [&](const std::vector<Polyline>& cracks) {
    const auto found = errors(plate, cracks, 1e-9);
    REQUIRE(found.size() == 1);
    return found[0].where + ": " + found[0].what;
  };
  using Catch::Contains;
  CHECK_THAT(only({{{0, 0}}}), Contains("cracks[0]: has 1 vertices"));
  CHECK_THAT(only({{{0, 0}, {0, 0}}}), Contains("no length"));
  CHECK_THAT(only({{{0, 0}, {1.25, 0}}}), Contains("vertex 1 at (1.25, 0) lies 0.25 outside the outline"));
  CHECK_THAT(only({{{0, 0}, {0.5, 0.5}}}), Contains("vertex 1 at (0.5, 0.5) lies 0.25 inside holes[0]"));
  CHECK_THAT(only({{{0, 0.5}, {0.9, 0.5}}}), Contains("through holes[0] between (0.25, 0.5) and (0.75, 0.5)"));
  CHECK_THAT(only({{{-0.5, 1}, {0.5, 1}}}), Contains("lies on the edge top"));
  CHECK_THAT(only({{{0, 0}, {0, -0.5}, {-0.5, -0.5}, {0.2, -0.2}}}), Contains("segments 0 and 2 cross"));
  CHECK_THAT(only({{{0, 0}, {0.5, 0}, {0.25, 0}}}), Contains("run along each other"));
  CHECK_THAT(only({{{0, 0}, {0.5, 0}}, {{0.25, 0}, {0.75, 0}}}), Contains("cracks[1]: runs along cracks[0]"));
  const Outline ell{{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}}, {}};
  const auto found = errors(ell, {{{0.5, 1.75}, {1.75, 0.5}}}, 1e-9);
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].what, Contains("outside the outline between (1, 1.25) and (1.25, 1)"));
}

TEST_CASE("cracks may cross, branch, end on edges and holes, and share ends") {
  Outline plate = rectangle(-1, -1, 1, 1);
  plate.holes.push_back(Circle{{0.5, 0.5}, 0.25, "hole0"});
  const std::vector<Polyline> cracks{{{-1, 0}, {0, 0}},
                                     {{-0.5, -0.5}, {-0.5, 0.5}},
                                     {{0, 0}, {0.3, -0.3}},
                                     {{0, 0.5}, {0.25, 0.5}},
                                     {{0.9, 1 + 1e-12}, {0.9, 0.8}}};
  CHECK(errors(plate, cracks, 1e-9).empty());
}

TEST_CASE("distance from a polyline") {
  const Polyline path{{0, 0}, {2, 0}, {2, 2}};
  CHECK(distance(path, {1, 0.5}) == Approx(0.5));
  CHECK(distance(path, {-3, 4}) == Approx(5));
  CHECK(distance(path, {1.75, 1}) == Approx(0.25));
}
