#include "fracture/growth/moving_bonds_and_tips.hpp"

#include "tests/catch.hpp"
#include "tests/unit/fracture/distributed_run.hpp"
#include "tests/unit/fracture/growth/moving_plate.hpp"

using namespace fracture;
namespace mp = moving_plate;

TEST_CASE("moving tips: a crack runs no faster than it may, and takes what the plate loses") {
  const mp::Motion motion(mp::content(Growth::Criterion::energy_release));
  MovingTips growth(*motion.c.growth, *motion.start, {}, 1);
  const auto energies = motion.move(growth, 600);
  const auto outcome = growth.outcome();
  REQUIRE(outcome.advances > 3);
  CHECK(outcome.largest_speed <= 0.93 * motion.c.section.shear_wave_speed() * (1 + 1e-9));
  CHECK(outcome.largest_speed > 0);
  REQUIRE(outcome.lengths.size() == 1);
  CHECK(outcome.lengths[0] > 0.8 + 0.3);
  CHECK(growth.fracture_energy() > 0);
  CHECK(energies.energy + growth.fracture_energy() == Approx(energies.work).epsilon(1e-9));
  const auto& record = growth.record();
  REQUIRE(record.tips.rows.size() == outcome.advances);
  for (std::size_t i = 1; i < outcome.advances; ++i) {
    const auto time = [&](std::size_t row) {
      return std::get<double>(record.tips.rows[row][record.tips.column("time")]);
    };
    CHECK(time(i) > time(i - 1));
  }
  CHECK(record.cracks.lines[0].vertices.size() == outcome.advances + 2);
}

TEST_CASE("moving tips: tension alone or beside bending drives them, and energies balance in both fields") {
  auto c = mp::content(Growth::Criterion::energy_release);
  const double traction = 60;
  const bool bent = GENERATE(false, true);
  c.growth->fracture_energy = 2000;
  if (!bent) c.loads.clear();
  c.loads.push_back(plate::Load{plate::EdgeTraction{.edges = {"bottom", "top"}, .value = traction}});
  c.joined_with_plane = true;
  const mp::Motion motion(c);
  REQUIRE(motion.found.membrane);
  const auto grown = [&] { return moving_growth(*motion.c.growth, *motion.start, {}, 1, motion.found.membrane.get()); };
  const auto whole = grown(), later = grown();
  plate::MotionCheckpoint memory;
  const auto energies = motion.move(*whole, 500, nullptr, [&](const plate::MotionCheckpoint& now) {
    if (now.step == 400) memory = now, mp::hand_over(*whole, *later);
  });
  const double fracture = whole->fracture_energy();
  CAPTURE(bent, energies.work, energies.energy, fracture, whole->outcome().advances);
  CHECK(whole->outcome().advances > 3);
  CHECK(fracture > 0.001 * energies.work);
  CHECK(energies.energy + fracture == Approx(energies.work).epsilon(1e-9));
  motion.move(*later, 500, &memory);
  CHECK(later->fracture_energy() == fracture);
}

TEST_CASE("moving tips: below its fracture energy a tip stays, and its plate is the one at the start") {
  auto c = mp::content(Growth::Criterion::energy_release);
  c.growth->fracture_energy = 1e6;
  const mp::Motion motion(c);
  MovingTips growth(*motion.c.growth, *motion.start, {}, 1);
  const auto energies = motion.move(growth, 100);
  CHECK(growth.outcome().advances == 0);
  CHECK_FALSE(growth.outcome().spent);
  CHECK(growth.outcome().parts == growth.outcome().parts_before);
  CHECK(growth.fracture_energy() == 0);
  CHECK(energies.energy == Approx(energies.work));
}

TEST_CASE("moving tips: two that run at each other at less than half a spacing meet halfway, alike") {
  auto c = mp::content(Growth::Criterion::energy_release);
  c.discretization.spacing = 0.05;
  c.growth->fracture_energy = 100;
  c.cracks = {{{-0.8, 0.01}, {-0.3, 0.01}}, {{0.3, -0.01}, {0.8, -0.01}}};  // turned by half a turn, alike
  const mp::Motion motion(c);
  MovingTips growth(*motion.c.growth, *motion.start, {}, 1);
  const auto energies = motion.move(growth, 400);
  CHECK(energies.energy + growth.fracture_energy() == Approx(energies.work).epsilon(1e-9));
  const auto& lines = growth.record().cracks.lines;
  REQUIRE(lines[0].vertices.size() == lines[1].vertices.size());
  const auto& first = lines[0].vertices;
  const auto& second = lines[1].vertices;
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK((first[i] + second[second.size() - 1 - i]).norm() < 1e-6 * 0.05);
    CHECK(lines[0].advances[i] == Approx(lines[1].advances[second.size() - 1 - i]));
  }
  CHECK(first.back().norm() < 1e-6 * 0.05);
  CHECK(growth.outcome().reached == std::vector<std::string>{"crack 1", "crack 0"});
}

TEST_CASE("moving tips: one that goes on from memory grows as if it had never stopped") {
  const mp::Motion motion(mp::content(Growth::Criterion::energy_release));
  MovingTips whole(*motion.c.growth, *motion.start, {}, 1), later(*motion.c.growth, *motion.start, {}, 1);
  plate::MotionCheckpoint memory;
  motion.move(whole, 400, nullptr, [&](const plate::MotionCheckpoint& now) {
    if (now.step == 300) memory = now, mp::hand_over(whole, later);
  });
  const auto then = later.outcome().advances;
  motion.move(later, 400, &memory);
  CHECK(later.fracture_energy() == whole.fracture_energy());
  CHECK(later.outcome().advances > then);
  CHECK(later.record().tips.rows == whole.record().tips.rows);
}

TEST_CASE("a plate in parts: tips that run across borders and turn") {
  auto file = shared_run::moving(shared_run::tall_plate(), 0.15);
  auto& c = file.content;
  c.srif.emplace().methods = {post::SrifMethod::virtual_crack_extension};
  SECTION("two tips, along a line of the lattice") {
    c.growth->direction = Growth::Direction::straight;
  }
  SECTION("oblique, with turns") {
    c.cracks = {{{0.4, 0.51}, {0.5, 0.91}}};
  }
  const auto one = shared_run::texts(file, 1);
  REQUIRE(one.contains("tips"));
  CHECK(std::ranges::count(one.at("tips"), '\n') > 2);  // measured: 10 and 3 lines
  for (const int processes : {2, 3, 4}) {
    INFO(processes << " processes");
    CHECK((shared_run::texts(file, processes) == one));
  }
}
