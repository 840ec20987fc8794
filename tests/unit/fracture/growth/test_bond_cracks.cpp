#include "fracture/growth/bond_cracks.hpp"

#include "tests/catch.hpp"
#include "tests/verification/verified_plate.hpp"

using namespace fracture;
using geometry::Point;
namespace vp = verified_plate;

namespace {

/// 20 x 20 points, with a crack from the left edge to x = -0.5.
struct EdgeCrack {
  std::unique_ptr<plate::Formulation> plate;
  Record record;

  EdgeCrack() {
    auto c = vp::square(0.1);
    c.cracks = {{{-1, 0}, {-0.5, 0}}};
    plate = vp::assembled(c);
  }
  std::uint32_t at(double x, double y) const { return geometry::nearest_plate_point(plate->cloud(), {x, y}); }
  /// The bond across y at x.
  LoadedBond across(double x, double y = 0) const { return {{at(x, y - 0.05), at(x, y + 0.05)}, 1}; }
};

}  // namespace

TEST_CASE("bond cracks: as they were given until bonds between neighbours break") {
  EdgeCrack s;
  BondCracks cracks(*s.plate);
  cracks.look(0, s.record, 0);
  CHECK(cracks.length() == Approx(0.5));
  REQUIRE(cracks.tips().size() == 1);
  CHECK((cracks.tips()[0].tip.position - Point(-0.5, 0)).norm() < 1e-12);
  CHECK_FALSE(cracks.broke({{{s.at(-0.45, -0.05), s.at(-0.25, 0.05)}, 1}}, 1));  // longer than a spacing
  CHECK(cracks.broken() == 1);
  CHECK(cracks.length_now() == Approx(0.5));
  CHECK(cracks.broke({s.across(-0.45)}, 2));
  CHECK_FALSE(cracks.broke({s.across(-0.45)}, 3));  // parted already
  CHECK(cracks.length() == Approx(0.5));
  CHECK(cracks.length_now() == Approx(0.6));
  CHECK(cracks.growth() == Approx(0.1));
  CHECK(cracks.broken() == 3);
}

TEST_CASE("bond cracks: a tip keeps its number, and has a speed once it has gone eight spacings") {
  EdgeCrack s;
  BondCracks cracks(*s.plate, 3.0);
  cracks.look(0, s.record, 0);
  for (int i = 1; i <= 10; ++i) {
    cracks.broke({s.across(-0.55 + 0.1 * i)}, 0.05 * i);
    cracks.look(0.05 * i, s.record, i);
    REQUIRE(cracks.tips().size() == 1);
    const auto& tip = cracks.tips()[0];
    CHECK(tip.number == 0);
    CHECK((tip.tip.position - Point(-0.5 + 0.1 * i, 0)).norm() < 1e-12);
    CHECK((tip.tip.direction - Point(1, 0)).norm() < 1e-12);
    CHECK(tip.speed == Approx(i < 8 ? 0 : 2).margin(1e-12));
  }
  CHECK(s.record.tips.rows.size() == 11);
  const auto drawn = cracks.drawn();
  REQUIRE(drawn.lines.size() == 1);
  CHECK(drawn.lines[0].advances.back() == Approx(0.5));
  CHECK(cracks.tips_of_cracks().size() == 1);
}

TEST_CASE("bond cracks: where a crack forks evenly, both branches are new, and both have come the same way") {
  EdgeCrack s;
  BondCracks cracks(*s.plate, 10.0);
  cracks.look(0, s.record, 0);
  for (int i = 0; i < 10; ++i) cracks.broke({s.across(-0.45 + 0.1 * i)}, 1);
  cracks.look(1, s.record, 1);
  const auto aside = [&](double y) { return LoadedBond{{s.at(0.45, y), s.at(0.55, y)}, 1}; };
  for (const double y : {0.05, 0.15, 0.25, -0.05, -0.15, -0.25}) cracks.broke({aside(y)}, 2);
  cracks.look(2, s.record, 2);
  REQUIRE(cracks.tips().size() == 2);
  for (const auto& tip : cracks.tips()) {
    CHECK(tip.number > 0);
    CHECK(tip.speed == Approx(std::hypot(1, 0.3) / 2));
    CHECK((tip.tip.position - Point(0.5, tip.tip.position.y() > 0 ? 0.3 : -0.3)).norm() < 1e-12);
  }
  CHECK(cracks.tips()[0].number != cracks.tips()[1].number);
}

TEST_CASE("bond cracks: a new crack has tips of new numbers, short ones are no cracks whose factors mean something") {
  EdgeCrack s;
  BondCracks cracks(*s.plate);
  cracks.look(0, s.record, 0);
  for (const double x : {0.15, 0.25}) cracks.broke({s.across(x, 0.6)}, 1);
  cracks.look(1, s.record, 1);
  CHECK(cracks.tips().size() == 1);  // two sides are a speck
  cracks.broke({s.across(0.35, 0.6)}, 2);
  cracks.look(2, s.record, 2);
  REQUIRE(cracks.tips().size() == 3);
  CHECK(cracks.length() == Approx(0.8));
  std::vector<std::size_t> numbers;
  for (const auto& tip : cracks.tips()) numbers.push_back(tip.number);
  std::ranges::sort(numbers);
  CHECK(numbers == std::vector<std::size_t>{0, 1, 2});
  CHECK(cracks.tips_of_cracks().empty());
}

TEST_CASE("bond cracks: cuts are the given cracks, what has parted since, and no gap between them") {
  EdgeCrack s;
  BondCracks cracks(*s.plate);
  CHECK(cracks.cuts().size() == 1);
  for (const double x : {-0.35, -0.25}) cracks.broke({s.across(x)}, 1);  // begins a spacing beyond the tip
  const auto parted = [&](double x) {
    return std::ranges::any_of(cracks.cuts(), [&](const geometry::CrackPath& cut) {
      return geometry::separates(cut, {x, -0.05}, {x, 0.05});
    });
  };
  for (const double x : {-0.75, -0.45, -0.35, -0.25}) CHECK(parted(x));
  CHECK_FALSE(parted(-0.15));
}
