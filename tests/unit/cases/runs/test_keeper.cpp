#include "cases/runs/recording.hpp"

#include "plate/solve/archive.hpp"
#include "tests/catch.hpp"
#include "tests/unit/post/small_run.hpp"

using fracture::Keeper;
using small_run::TemporaryFolder;

namespace {

Keeper::Remember number(int n) {
  return [n](plate::OutArchive& archive) { archive(n); };
}

int recalled(Keeper& keeper) {
  int n = 0;
  CHECK(keeper.recall([&](plate::InArchive& archive) { archive(n); }));
  return n;
}

}  // namespace

TEST_CASE("keeper: what was kept last comes back to the same run, once") {
  const TemporaryFolder folder;
  const post::Checkpoints same(folder.path(), "case 1");
  Keeper keeper(same, 1e-9);
  std::vector<std::string> refused;
  CHECK_FALSE(keeper.find(refused));
  CHECK_FALSE(keeper.recall([](plate::InArchive&) { FAIL("nothing was found"); }));
  keeper.keep(number(1)), keeper.hold(number(2));
  Keeper again(same, 1e-9);
  REQUIRE(again.find(refused));
  CHECK(refused.empty());
  CHECK(recalled(again) == 2);
  CHECK_FALSE(again.goes_on());
  Keeper other({folder.path(), "case 2"}, 1e-9);
  CHECK_FALSE(other.find(refused));
  CHECK_FALSE(refused.empty());
  keeper.done();
  CHECK(folder.entries() == 0);
}

TEST_CASE("keeper: before its time it writes nothing but what it is told to, and that once") {
  const TemporaryFolder folder;
  Keeper keeper({folder.path(), "case 1"}, 3600);
  CHECK_FALSE(keeper.due());
  keeper.hold(number(7));
  keeper.hold(number(8));  // within a second: not taken
  CHECK(folder.entries() == 0);
  keeper.write();
  CHECK(folder.entries() == 1);
  Keeper again({folder.path(), "case 1"}, 3600);
  std::vector<std::string> refused;
  REQUIRE(again.find(refused));
  CHECK(recalled(again) == 7);
  keeper.write();  // nothing has been taken since
  CHECK(folder.entries() == 1);
}

TEST_CASE("keeper: a run goes on where its checkpoint cannot be written") {
  const TemporaryFolder folder;
  Keeper keeper({folder / "gone", "case 1"}, 1e-9);
  CHECK_NOTHROW(keeper.keep(number(1)));
  CHECK_NOTHROW(keeper.keep(number(2)));
  std::vector<std::string> refused;
  CHECK_FALSE(keeper.find(refused));
}
