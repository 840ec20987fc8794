#include "fracture/growth/tip_advance.hpp"

#include <numbers>

#include "tests/catch.hpp"

using namespace fracture;
using geometry::Point;

namespace {

constexpr double degree = std::numbers::pi / 180, spacing = 0.1;

const auto outline = geometry::rectangle(0, 0, 10, 6);
const std::vector<geometry::Polyline> cracks{{{0, 3}, {4, 3}}, {{6, 1}, {6, 5}}};
const geometry::Tip tip{{4, 3}, {1, 0}, 0, true};

TipAdvance gone(double increment, double angle, bool long_leg, const geometry::Tip& from = tip) {
  Growth growth;
  growth.increment = increment;
  return advance(growth, outline, cracks, spacing, from, angle, long_leg);
}

}  // namespace

TEST_CASE("tip advance: straight on by the increment, turns below a degree are not made") {
  for (const double angle : {0.0, 0.9 * degree, -0.9 * degree}) {
    const auto way = gone(2, angle, turns(angle));
    CHECK((way.to - Point(4.2, 3)).norm() < 1e-14);
    CHECK(way.length == Approx(0.2));
    CHECK_FALSE(way.reached);
  }
}

TEST_CASE("tip advance: a piece after a turn is five spacings long, and an increment that is longer stays") {
  for (const double increment : {1.0, 8.0})
    for (const double angle : {30 * degree, -1.1 * degree}) {
      const auto way = gone(increment, angle, turns(angle));
      const double length = std::max(increment, 5.0) * spacing;
      CHECK(way.length == Approx(length));
      CHECK((way.to - Point(4 + length * std::cos(angle), 3 + length * std::sin(angle))).norm() < 1e-14);
    }
  // longer where it is asked for, as far as five spacings are left before what is ahead
  const auto longer = [](double from) {
    return advance({}, outline, cracks, spacing, {{from, 3}, {1, 0}, 0, true}, 0, true, 10).length;
  };
  CHECK(longer(4) == Approx(10 * spacing));
  CHECK(longer(4.8) == Approx(7 * spacing));  // crack 1 is 12 spacings ahead
  // with the long piece of another tip, small turns are made
  CHECK(gone(1, 0.5 * degree, true).to.y() > 3.004);
  CHECK(gone(1, 0.1 * degree, true).to.y() == 3);
}

TEST_CASE("tip advance: pieces end at the largest length of a crack, after a turn they are five spacings long") {
  const std::vector<geometry::Polyline> free{{{2, 3}, {4, 3}}};
  const std::vector<geometry::Tip> tips{{{4, 3}, {1, 0}, 0, true}, {{2, 3}, {-1, 0}, 0, false}};
  Growth growth;
  growth.increment = 8;
  const auto gone_together = [&](double most, double angle) {
    growth.max_length = most;
    std::vector<std::optional<TipAdvance>> ways;
    for (const auto& one : tips) ways.emplace_back(advance(growth, outline, free, spacing, one, angle, turns(angle)));
    end_at_longest(growth, free, spacing, tips, ways);
    return std::pair(ways[0]->length, (ways[1]->to - tips[1].position).norm());
  };
  CHECK(gone_together(5, 0) == std::pair(0.8, 0.8));
  CHECK(gone_together(2.5, 0).first == Approx(0.25));
  CHECK(gone_together(2.5, 0).second == Approx(0.25));
  CHECK(gone_together(2.5, 30 * degree).first == Approx(5 * spacing));
  CHECK(gone_together(3.2, 30 * degree).second == Approx(0.6));
}

TEST_CASE("tip advance: what lies within five spacings ahead of a piece is reached") {
  const geometry::Tip near{{5.3, 3}, {1, 0}, 0, true};
  auto way = gone(2.1, 0, false, near);
  REQUIRE(way.reached);
  CHECK((way.to - Point(6, 3)).norm() < 1e-12);
  CHECK(way.length == Approx(0.7));
  CHECK(name_of(*way.reached) == "crack 1");
  CHECK_FALSE(gone(1.9, 0, false, near).reached);
  way = gone(1, 90 * degree, true, {{5, 5.3}, {1, 0}, 0, true});
  REQUIRE(way.reached);
  CHECK(way.to.y() == Approx(6));
  CHECK(name_of(*way.reached) == "'top'");
}

TEST_CASE("tip advance: what breaks through goes to what is nearest ahead or beside, and not far") {
  const auto way = break_through(outline, cracks, spacing, {{5.8, 3}, {1, 0}, 0, true});
  REQUIRE(way);
  CHECK((way->to - Point(6, 3)).norm() < 1e-12);
  CHECK(way->length == Approx(0.2));
  CHECK(way->reached->crack == std::size_t(1));
  CHECK(name_of(*break_through(outline, cracks, spacing, {{4, 0.3}, {1, 0}, 0, true})->reached) == "'bottom'");
  CHECK_FALSE(break_through(outline, cracks, spacing, {{5.8, 3}, {-1, 0}, 0, true}));  // behind it
  CHECK_FALSE(break_through(outline, cracks, spacing, {{5.2, 3}, {1, 0}, 0, true}));   // eight spacings
}

TEST_CASE("tip advance: tips that run at each other meet halfway") {
  const std::vector<geometry::Polyline> facing{{{0, 3}, {4, 3}}, {{4.6, 3}, {9, 3}}};
  const std::vector<geometry::Tip> tips{{{4, 3}, {1, 0}, 0, true}, {{4.6, 3}, {-1, 0}, 1, false}};
  std::vector<std::optional<TipAdvance>> ways;
  for (const auto& one : tips) ways.push_back(advance({}, outline, facing, spacing, one, 0, false));
  REQUIRE((ways[0]->reached && ways[0]->reached->crack == std::size_t(1)));  // though it lies along its way
  auto one = ways;
  one[1].reset();
  meet(tips, one);
  CHECK((one[0]->to - Point(4.6, 3)).norm() < 1e-12);  // the other stays
  meet(tips, ways);
  for (const auto& way : ways) {
    CHECK((way->to - Point(4.3, 3)).norm() < 1e-12);
    CHECK(way->length == Approx(0.3));
  }
}

TEST_CASE("tip advance: ways that cross end there, whichever tip is the first") {
  // mirror images about x = 5, which meet at (5, 3)
  const std::vector<geometry::Polyline> slanted{{{4, 4}, {4.95, 3.05}}, {{6, 4}, {5.05, 3.05}}};
  const double diagonal = std::numbers::sqrt2 / 2;
  const geometry::Tip left{{4.95, 3.05}, {diagonal, -diagonal}, 0, true},
      right{{5.05, 3.05}, {-diagonal, -diagonal}, 1, true};
  for (const auto& tips : {std::vector{left, right}, {right, left}}) {
    std::vector<std::optional<TipAdvance>> ways;
    for (const auto& one : tips) ways.push_back(advance({}, outline, slanted, spacing, one, 0, false));
    CHECK_FALSE(ways[0]->reached);
    meet(tips, ways);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK((ways[i]->to - Point(5, 3)).norm() < 1e-12);
      CHECK(ways[i]->length == Approx(0.05 / diagonal));
      REQUIRE(ways[i]->reached);
      CHECK(ways[i]->reached->crack == tips[1 - i].crack);
    }
  }
}

TEST_CASE("tip advance: another crack that a tip would pass at less than half a spacing is reached") {
  const auto beside = [](double y) {
    const std::vector<geometry::Polyline> two{{{0, 3}, {4, 3}}, {{4.3, 3 + y}, {9, 3 + y}}};
    return advance({}, outline, two, spacing, tip, 0, false);
  };
  for (const double y : {0.049, -0.049, 0.0005}) {
    const auto way = beside(y);
    REQUIRE(way.reached);
    CHECK(way.reached->crack == std::size_t(1));
    CHECK((way.to - Point(4.3, 3 + y)).norm() < 1e-12);
    CHECK(way.length == Approx(std::hypot(0.3, y)));
  }
  CHECK_FALSE(beside(0.051).reached);
  // beside its own tip, and on it; what lies behind does not count
  const auto along = [](const geometry::Polyline& other) {
    return advance({}, outline, {{{0, 3}, {4, 3}}, other}, spacing, tip, 0, false);
  };
  CHECK((along({{3, 3.03}, {9, 3.03}}).to - Point(4, 3.03)).norm() < 1e-12);
  CHECK(touches_at_once(along({{4, 3}, {4.5, 4}}), spacing));
  CHECK_FALSE(along({{3, 3.03}, {3.9, 3.03}}).reached);
  // between mirror images of a crack a tip goes on
  const std::vector<geometry::Polyline> gate{{{0, 3}, {4, 3}}, {{4.3, 3.03}, {4.3, 5}}, {{4.3, 2.97}, {4.3, 1}}};
  CHECK_FALSE(advance({}, outline, gate, spacing, tip, 0, false).reached);
}
