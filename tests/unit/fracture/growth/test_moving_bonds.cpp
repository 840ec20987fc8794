#include "fracture/growth/moving_bonds_and_tips.hpp"

#include "tests/catch.hpp"
#include "tests/unit/fracture/distributed_run.hpp"
#include "tests/unit/fracture/growth/moving_plate.hpp"

using namespace fracture;
namespace mp = moving_plate;

namespace {

cases::Case content() {
  auto c = mp::content(Growth::Criterion::bond_energy);
  c.growth->apparent_toughness = 1;
  return c;
}

}  // namespace

TEST_CASE("moving bonds: what breaks takes what the plate loses, and a row of the history is an advance") {
  const mp::Motion motion(content());
  MovingBonds growth(*motion.c.growth, *motion.start, {}, 1);
  const auto energies = motion.move(growth, 400);
  const auto outcome = growth.outcome();
  REQUIRE(outcome.broken);
  CHECK(*outcome.broken > 10);
  CHECK(outcome.advances > 0);
  CHECK(energies.energy + growth.fracture_energy() == Approx(energies.work).epsilon(1e-9));
  const auto& record = growth.record();
  CHECK(record.growth.rows.size() == 400 / 20 + 1);
  const auto broken = record.growth.column("broken_bonds");
  CHECK(std::get<double>(record.growth.rows.back()[broken]) == double(*outcome.broken));
  CHECK(outcome.lengths.front() > 0.8);
}

TEST_CASE("moving bonds: no more break after the largest number of advances, or beyond the largest length") {
  auto c = content();
  c.growth->max_advances = 3;
  const mp::Motion few(c);
  MovingBonds by_number(*few.c.growth, *few.start, {}, 1);
  few.move(by_number, 400);
  CHECK(by_number.outcome().advances == 3);
  c = content();
  c.growth->max_length = 1;
  const mp::Motion some(c);
  MovingBonds by_length(*some.c.growth, *some.start, {}, 1);
  some.move(by_length, 400);
  CHECK(by_length.outcome().lengths.front() >= 1);
  CHECK(by_length.outcome().lengths.front() < 1.31);  // all that break in one step
}

TEST_CASE("moving bonds: one that goes on from memory grows as if it had never stopped") {
  const mp::Motion motion(content());
  MovingBonds whole(*motion.c.growth, *motion.start, {}, 1), later(*motion.c.growth, *motion.start, {}, 1);
  plate::MotionCheckpoint memory;
  motion.move(whole, 300, nullptr, [&](const plate::MotionCheckpoint& now) {
    if (now.step == 200) memory = now, mp::hand_over(whole, later);
  });
  const auto then = *later.outcome().broken;
  motion.move(later, 300, &memory);
  CHECK(*later.outcome().broken > then);
  CHECK(*later.outcome().broken == *whole.outcome().broken);
  CHECK(later.fracture_energy() == whole.fracture_energy());
  CHECK(later.record().growth.rows == whole.record().growth.rows);
}

TEST_CASE("a plate in parts: bonds that break across borders, and a piece that they cut off") {
  auto file = shared_run::moving(shared_run::cut_plate(), 0.3);
  auto& growth = *file.content.growth;
  growth.criterion = Growth::Criterion::bond_energy;
  growth.direction = Growth{}.direction;
  growth.apparent_toughness = 1;
  file.content.srif.emplace().methods = {post::SrifMethod::virtual_crack_extension};
  CHECK(shared_run::falls(file));
  const auto one = shared_run::texts(file, 1);
  CHECK(std::ranges::count(one.at("srif"), '\n') > 10);
  for (const int processes : {2, 3, 4}) {
    INFO(processes << " processes");
    CHECK((shared_run::texts(file, processes) == one));
  }
}
