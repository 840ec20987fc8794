// A motion that some processes have kept goes on by others, to the same tables. Kills: tests/distributed/kills.
#include <mutex>

#include "cases/runs/analyses.hpp"
#include "cases/runs/checkpoints.hpp"
#include "cases/runs/outputs.hpp"
#include "plate/formulation/discretised.hpp"
#include "plate/formulation/formulation.hpp"
#include "plate/solve/motion/initial_conditions.hpp"
#include "post/files/sinks.hpp"
#include "tests/unit/cases/case_text.hpp"
#include "tests/unit/fracture/distributed_run.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace case_text;

namespace {

struct Moved {
  post::ResultsInMemory in_memory;
  post::Summary summary;
  std::vector<std::string> refused;  // checkpoints; looked at by one thread
  bool went_on = false;
};

cases::CaseFile of_motion() {
  return read(plain, {"discretization.spacing=0.02", "discretization.formulation=ordinary", "section.density=1",
                      "analysis={kind=\"dynamic\",duration=1}", "output.probes={a=[0.5,0.3]}", "load[0].history=sine",
                      "load[0].frequency=3", "foundation[0].modulus=5"});
}

/// So many steps by one of the processes; `folder`: of its checkpoints.
Moved moved(cases::CaseFile file, const plate::Communicator& all, std::size_t steps,
            const std::filesystem::path& folder) {
  if (auto& initial = file.content.initial)  // formulas are evaluated by one thread at a time
    initial->velocity = plate::Formula(initial->velocity.text());
  cases::ValidatedPlate ready;
  ready.plate = plate::discretise(file.content, all).plate;
  ready.begin = plate::begin_of_motion(*ready.plate, 1);
  const double limit =
      plate::stable_step(plate::stable_time_step(*ready.plate, 1), *ready.plate, file.content.analysis, ready.begin);
  ready.steps = {limit, {0.9 * limit, steps, 5}};
  Moved result;
  plate::Stopwatch stopwatch;
  cases::Outputs outputs({file.content, {{}, true, &result.in_memory, false, &all}},
                         {std::make_unique<post::MemorySink>(result.in_memory), "", "", post::ProcessesOfRun(all)},
                         stopwatch);
  cases::RunCheckpoints checkpoints(post::Checkpoints(all, folder, "case"), 1e-9);
  result.went_on = checkpoints.find(result.refused);
  result.summary = cases::run(ready, outputs, &checkpoints);
  return result;
}

Moved moved_by(const cases::CaseFile& file, int processes, std::size_t steps, const std::filesystem::path& folder) {
  Moved first;
  std::mutex one_by_one;
  thread_ranks::run(processes, [&](const plate::Communicator& all) {
    auto own = moved(file, all, steps, folder);
    const std::lock_guard guard(one_by_one);
    if (all.rank() == 0) first = std::move(own);
  });
  return first;
}

void require_same(const Moved& gone_on, const Moved& whole) {
  CHECK(gone_on.went_on);
  CHECK(gone_on.refused.empty());
  CHECK_FALSE(whole.went_on);
  const auto &tables = gone_on.in_memory.tables, &of_whole = whole.in_memory.tables;
  REQUIRE(tables.size() == of_whole.size());
  for (std::size_t i = 0; i < tables.size(); ++i) {
    CHECK(tables[i].first == of_whole[i].first);
    CHECK((tables[i].second.rows == of_whole[i].second.rows));
  }
  REQUIRE(gone_on.summary.peaks.size() == whole.summary.peaks.size());
  for (std::size_t i = 0; i < whole.summary.peaks.size(); ++i) {
    const auto &one = gone_on.summary.peaks[i], &other = whole.summary.peaks[i];
    CHECK((one.value == other.value && one.time == other.time && one.position == other.position));
  }
}

}  // namespace

TEST_CASE("a motion in parts that was kept goes on by another number of processes, with the same tables") {
  constexpr std::size_t all = 30;
  auto file = of_motion();
  std::size_t tables = 3;
  SECTION("without damping") {}
  SECTION("with a damping of the mass") {
    file.content.analysis.damping = plate::Damping{0.5, 0};
  }
  SECTION("with a damping of the stiffness, a velocity to begin with, and a mass that hits") {
    file.content.analysis.damping = plate::Damping{0.5, 1e-5};
    file.content.initial = plate::Initial{{}, plate::Formula("x + 1")};
    file.content.impact = plate::Impact{{0.305, 0.325}, 1e-3, -1, 1e5};
    tables = 4;
  }
  SECTION("with supports that move, perhaps damped") {
    if (GENERATE(false, true)) file.content.analysis.damping = plate::Damping{0.5, 1e-5};
    auto& settlement = file.content.loads.emplace_back();
    settlement.action = plate::Settlement{.value = 0.1, .rotation = 0.2};
    settlement.history.kind = plate::History::Kind::table, settlement.history.table = {{0, 0}, {0.01, 0.1}, {0.02, 1}};
  }
  SECTION("with a force that moves") {
    file.content.loads.push_back(
        plate::Load{plate::PointForce{.value = 2, .path = {{-0.5, 0.3}, {0.5, 0.35}, {0.7, -0.2}}, .speed = 50}});
  }
  SECTION("on soil that lifts off") {
    file.content.foundations.front().unilateral = true;
  }
  const small_run::TemporaryFolder alone;
  const auto whole = moved_by(file, 2, all, alone.path());
  CHECK(whole.in_memory.tables.size() == tables);
  CHECK(whole.summary.peaks.size() >= 2);
  for (const auto& [before, after, kept] : {std::array{4, 1, 15}, {1, 3, 25}}) {
    INFO(before << " processes, then " << after);
    const small_run::TemporaryFolder folder;
    moved_by(file, before, std::size_t(kept), folder.path());
    const auto gone_on = moved_by(file, after, all, folder.path());
    require_same(gone_on, whole);
  }
  const small_run::TemporaryFolder peace, ended;  // of one process with the whole plate
  moved(file, plate::single_process(), 17, ended.path());
  require_same(moved(file, plate::single_process(), all, ended.path()),
               moved(file, plate::single_process(), all, peace.path()));
}

TEST_CASE("cracks that grow in a motion in parts that was kept go on by another number of processes") {
  cases::CaseFile file;
  std::size_t all = 0;
  std::vector<std::array<int, 3>> runs;  // processes before and after, steps between
  SECTION("tips that run") {
    file = shared_run::moving(shared_run::tall_plate(), 1);
    file.content.cracks = {{{0.4, 0.51}, {0.5, 0.91}}};
    file.content.growth->direction = fracture::Growth::Direction::straight;  // no other is resolved at this spacing
    all = 200, runs = {{2, 3, 120}};
  }
  SECTION("bonds that break, and a piece that they cut off") {
    file = shared_run::moving(shared_run::cut_plate(), 1);
    file.content.growth->criterion = fracture::Growth::Criterion::bond_energy;
    file.content.growth->direction = fracture::Growth{}.direction;
    file.content.growth->apparent_toughness = 1;
    all = 400, runs = {{3, 1, 150}};
  }
  const small_run::TemporaryFolder alone;
  const auto whole = moved_by(file, 2, all, alone.path());
  CHECK(whole.summary.growth->advances > 1);
  for (const auto& [before, after, kept] : runs) {
    INFO(before << " processes, then " << after);
    const small_run::TemporaryFolder folder;
    const auto first = moved_by(file, before, std::size_t(kept), folder.path());
    CHECK(first.summary.growth->advances > 0);
    CHECK(first.summary.growth->advances < whole.summary.growth->advances);
    const auto gone_on = moved_by(file, after, all, folder.path());
    require_same(gone_on, whole);
  }
}
