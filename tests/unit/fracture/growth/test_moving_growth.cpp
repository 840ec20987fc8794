#include "fracture/growth/moving_bonds_and_tips.hpp"

#include "tests/catch.hpp"
#include "tests/unit/fracture/growth/moving_plate.hpp"

using namespace fracture;
namespace mp = moving_plate;

TEST_CASE("moving growth: tips or bonds by the criterion, at first the plate as it was given") {
  for (const auto criterion : {Growth::Criterion::energy_release, Growth::Criterion::bond_energy}) {
    const auto c = mp::content(criterion);
    const auto start = verified_plate::assembled(c);
    const auto growth = moving_growth(*c.growth, *start, {}, 1);
    CHECK((dynamic_cast<MovingTips*>(growth.get()) != nullptr) == (criterion == Growth::Criterion::energy_release));
    const auto u = verified_plate::random_state(*start, 3);
    plate::Forces before, now;
    start->internal_force(u, before);
    growth->plate().internal_force(u, now);
    CHECK((before - now).cwiseAbs().maxCoeff() <= 1e-13 * before.cwiseAbs().maxCoeff());
    CHECK(growth->factors(u).empty());  // none are wanted
    CHECK(growth->frozen_energy() == 0);
    CHECK(growth->record().in_motion);
    post::Frame frame;
    growth->draw(frame, u, {});
    REQUIRE(frame.cracks);
    CHECK(frame.cracks->lines.size() == 1);
    CHECK(*std::ranges::max_element(frame.damage) == 0);
  }
}

TEST_CASE("moving growth: pieces that fall off are looked for where they are to stay") {
  auto c = mp::content(Growth::Criterion::energy_release);
  const auto start = verified_plate::assembled(c);
  auto& growth = *c.growth;
  const auto moving = moving_growth(growth, *start, {}, 1);
  CHECK_FALSE(dynamic_cast<DetachedPieces*>(&moving->changes()));
  growth.detached = Growth::Detached::freeze;
  const auto freezing = moving_growth(growth, *start, {}, 1);
  CHECK(dynamic_cast<DetachedPieces*>(&freezing->changes()));
  CHECK(&freezing->changes() == &freezing->changes());
  CHECK(freezing->outcome().frozen);
}

TEST_CASE("moving growth: factors of a tip are those of its plate at rest, normalised where that is asked for") {
  auto c = mp::content(Growth::Criterion::energy_release);
  c.supports = {verified_plate::held(plate::SupportKind::clamped, {"bottom"})};
  c.loads[0].as<plate::EdgeMoment>()->edges = {"top"};
  const auto start = verified_plate::assembled(c);
  post::SrifOptions options;
  options.methods = {post::SrifMethod::virtual_crack_extension, post::SrifMethod::domain_integral};
  const auto growth = moving_growth(*c.growth, *start, options, 1);
  const auto u = verified_plate::solved(*start, 1e-9).state;
  const auto factors = growth->factors(u);
  REQUIRE(factors.size() == 2);
  for (const auto& one : factors) {
    CHECK(one.tip == 0);
    CHECK(std::abs(one.K1) > 0);
    CHECK(*one.G > 0);
  }
  CHECK(factors[0].K1 == Approx(factors[1].K1).epsilon(0.1));
  const auto twice = growth->factors(2 * u);
  CHECK(twice[0].K1 == Approx(2 * factors[0].K1));
  CHECK(*twice[0].G == Approx(4 * *factors[0].G));
}
