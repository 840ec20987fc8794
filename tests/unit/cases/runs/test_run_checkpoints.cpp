#include "cases/runs/checkpoints.hpp"

#include "plate/model/point_map.hpp"
#include "plate/solve/archive.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using cases::RunCheckpoints;
using small_run::TemporaryFolder;

namespace {

/// Checkpoints of one process.
RunCheckpoints of(const std::filesystem::path& folder, double every, const std::string& run = "case 1") {
  return {post::Checkpoints(plate::single_process(), folder, run), every};
}

RunCheckpoints::SaveState saving(int n) {
  return [n](plate::OutArchive& archive) { archive(n); };
}

post::CellValues no_points() {
  return {};
}

int restored(RunCheckpoints& checkpoints) {
  int n = 0;
  CHECK(checkpoints.restore([&](plate::InArchive& archive) { archive(n); }));
  return n;
}

}  // namespace

TEST_CASE("keeper: what was kept last comes back to the same run, once") {
  const TemporaryFolder folder;
  auto checkpoints = of(folder.path(), 1e-9);
  std::vector<std::string> refused;
  CHECK_FALSE(checkpoints.find(refused));
  CHECK_FALSE(checkpoints.restore([](plate::InArchive&) { FAIL("nothing was found"); }));
  checkpoints.save(saving(1), no_points), checkpoints.hold(saving(2), no_points);
  auto again = of(folder.path(), 1e-9);
  REQUIRE(again.find(refused));
  CHECK(refused.empty());
  CHECK(restored(again) == 2);
  CHECK_FALSE(again.goes_on());
  auto other = of(folder.path(), 1e-9, "case 2");
  CHECK_FALSE(other.find(refused));
  CHECK_FALSE(refused.empty());
  checkpoints.done();
  CHECK(folder.entries() == 0);
}

TEST_CASE("keeper: before its time it writes nothing but what it is told to, and that once") {
  const TemporaryFolder folder;
  auto checkpoints = of(folder.path(), 3600);
  CHECK_FALSE(checkpoints.due());
  checkpoints.hold(saving(7), no_points);
  checkpoints.hold(saving(8), no_points);  // within a second: not taken
  CHECK(folder.entries() == 0);
  checkpoints.write();
  CHECK(folder.entries() == 2);
  auto again = of(folder.path(), 3600);
  std::vector<std::string> refused;
  REQUIRE(again.find(refused));
  CHECK(restored(again) == 7);
  checkpoints.write();  // nothing has been taken since
  CHECK(folder.entries() == 2);
}

TEST_CASE("keeper: a run goes on where its checkpoint cannot be written") {
  const TemporaryFolder folder;
  auto checkpoints = of(folder / "gone", 1e-9);
  CHECK_NOTHROW(checkpoints.save(saving(1), no_points));
  CHECK_NOTHROW(checkpoints.save(saving(2), no_points));
  std::vector<std::string> refused;
  CHECK_FALSE(checkpoints.find(refused));
}
