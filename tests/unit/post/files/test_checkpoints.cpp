#include "post/files/checkpoints.hpp"

#include <fstream>
#include <mutex>

#include "plate/model/point_map.hpp"
#include "post/files/atomic_file.hpp"
#include "post/files/run_folder.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace post;
namespace fs = std::filesystem;

namespace {

/// Checkpoints of one process.
Checkpoints alone(const fs::path& folder, const std::string& of = "case 1") {
  return {plate::single_process(), folder, of};
}

/// By so many ranks, each with one point of its own.
void write(const fs::path& folder, int ranks, const std::vector<std::string>& memories) {
  thread_ranks::run(ranks, [&](const plate::Communicator& all) {
    Checkpoints checkpoints(all, folder, "case 1");
    for (const auto& memory : memories) checkpoints.write(memory, {1, {{all.rank(), 0}}, {double(memory.size())}});
  });
}

struct ReadBack {
  std::optional<std::string> memory;
  std::size_t parts = 0;
  std::vector<std::string> refused;
};

ReadBack read(Checkpoints checkpoints) {
  ReadBack result;
  if (auto found = checkpoints.read(result.refused)) result.memory = found->memory, result.parts = found->parts.size();
  return result;
}

/// By so many; all must have found the same.
ReadBack read(const fs::path& folder, int ranks, const std::string& of = "case 1") {
  std::vector<ReadBack> found;
  std::mutex one_by_one;
  thread_ranks::run(ranks, [&](const plate::Communicator& all) {
    auto own = read(Checkpoints(all, folder, of));
    const std::lock_guard guard(one_by_one);
    found.push_back(std::move(own));
  });
  for (const auto& one : found) CHECK((one.memory == found[0].memory && one.refused == found[0].refused));
  return found[0];
}

void damage(const fs::path& path) {
  auto text = read_text(path);
  text[text.size() / 2] ^= 1;
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("checkpoints: the newest comes back, two are kept, none is left of what was removed") {
  const ScratchFolder scratch("pdplate_checkpoint");
  auto checkpoints = alone(scratch.path());
  CHECK_FALSE(read(checkpoints).memory);
  CHECK_FALSE(checkpoints.any());
  const std::string odd("first\n\0with zeros", 17);
  checkpoints.write(odd, {});
  CHECK(checkpoints.any());
  CHECK(read(checkpoints).memory == odd);
  checkpoints.write("second", {}), checkpoints.write("third", {});
  CHECK(read(checkpoints).memory == "third");
  fs::remove(scratch.path() / "checkpoint");
  CHECK(read(checkpoints).memory == "second");
  for (const char* name : {"checkpoint.partial", "checkpoint.1.0.partial"})  // of a process that was killed
    std::ofstream(scratch.path() / name) << "half";
  checkpoints.remove();
  CHECK(fs::is_empty(scratch.path()));
}

TEST_CASE("checkpoints: the last stays where a run has ended, until one that goes on from it has its own") {
  const ScratchFolder scratch("pdplate_checkpoint");
  auto checkpoints = alone(scratch.path());
  checkpoints.keep_last();
  CHECK_FALSE(checkpoints.kept());
  for (const char* memory : {"first", "second", "third", "fourth"}) checkpoints.write(memory, {});
  checkpoints.keep_last();
  CHECK(checkpoints.kept());
  CHECK_FALSE(checkpoints.any());
  CHECK(std::distance(fs::directory_iterator(scratch.path()), {}) == 2);
  auto later = alone(scratch.path());
  std::vector<std::string> refused;
  const auto found = later.read(refused);
  REQUIRE(found);
  CHECK(found->memory == "fourth");
  later.write("fifth", {});
  CHECK(read(later).memory == "fifth");
  later.keep_last();
  CHECK(read(alone(scratch.path())).memory == "fifth");
  CHECK(std::distance(fs::directory_iterator(scratch.path()), {}) == 2);
}

TEST_CASE("checkpoints: any byte that is damaged or missing gives the one before, with a word about it") {
  const ScratchFolder scratch("pdplate_checkpoint");
  auto checkpoints = alone(scratch.path());
  checkpoints.write("older", {}), checkpoints.write("newer", {1, {{0, 0}}, {-0.0}});
  for (const char* name : {"checkpoint", "checkpoint.1.0"}) {
    INFO(name);
    const auto path = scratch.path() / name;
    const auto whole = read_text(path);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      auto text = whole;
      text[i] ^= 1;
      std::ofstream(path, std::ios::binary) << text;
      const auto damaged = read(checkpoints);
      REQUIRE(damaged.memory == "older");
      REQUIRE(damaged.refused.size() == 1);
      std::ofstream(path, std::ios::binary) << whole.substr(0, i);
      REQUIRE(read(checkpoints).memory == "older");
    }
    std::ofstream(path, std::ios::binary) << whole;
    CHECK(read(checkpoints).memory == "newer");
  }
}

TEST_CASE("checkpoints of another run are refused") {
  const ScratchFolder scratch("pdplate_checkpoint");
  alone(scratch.path()).write("of case 1", {});
  const auto found = read(alone(scratch.path(), "case 2"));
  CHECK_FALSE(found.memory);
  REQUIRE(found.refused.size() == 1);
  CHECK_THAT(found.refused[0], Catch::Contains("case 1, not case 2"));
}

TEST_CASE("checkpoints: one that cannot be written leaves those before") {
  const ScratchFolder scratch("pdplate_checkpoint");
  auto checkpoints = alone(scratch.path());
  checkpoints.write("good", {});
  CellValues many{1, std::vector<geometry::Cell>(1000), std::vector<double>(1000)};
  {
    const small_run::FullDisk full(1000);
    CHECK_THROWS_AS(checkpoints.write(std::string(100000, 'x'), {}), CheckpointNotWritten);
    CHECK_THROWS_AS(checkpoints.write("small", many), CheckpointNotWritten);
  }
  CHECK(read(checkpoints).memory == "good");
  CHECK_FALSE(fs::exists(scratch.path() / "checkpoint.partial"));
  CHECK_FALSE(fs::exists(scratch.path() / "checkpoint.1.0.partial"));
  checkpoints.write("better", many);
  CHECK(read(checkpoints).memory == "better");
}

TEST_CASE("checkpoints: the newest of several ranks comes back to any number of them") {
  const small_run::TemporaryFolder folder;
  CHECK_FALSE(read(folder.path(), 3).memory);
  write(folder.path(), 3, {"first", std::string("second\n\0 of all", 15)});
  for (const int ranks : {1, 2, 5}) {
    const auto found = read(folder.path(), ranks);
    CHECK(found.memory == std::string("second\n\0 of all", 15));
    CHECK(found.parts == 3);
    CHECK(found.refused.empty());
  }
  thread_ranks::run(2, [&](const plate::Communicator& all) { Checkpoints(all, folder.path(), "case 1").remove(); });
  CHECK(folder.entries() == 0);
}

TEST_CASE("checkpoints: one of several ranks that is damaged anywhere gives the one before, with a word about it") {
  for (const char* name : {"checkpoint", "checkpoint.2.0", "checkpoint.2.1", "checkpoint.2.2"}) {
    INFO(name);
    const small_run::TemporaryFolder folder;
    write(folder.path(), 3, {"first", "the second", "the third of all"});
    damage(folder / name);
    const auto found = read(folder.path(), 2);
    CHECK(found.memory == "the second");
    REQUIRE(found.refused.size() == 1);
    CHECK_THAT(found.refused[0], Catch::Contains(name) && Catch::Contains("is damaged or not whole"));
    damage(folder / "checkpoint.1.1");
    CHECK_FALSE(read(folder.path(), 4).memory);
    CHECK(read(folder.path(), 4).refused.size() == 2);
  }
}

TEST_CASE("checkpoints: the last two of several ranks stay whole while a third is written") {
  const small_run::TemporaryFolder folder;
  write(folder.path(), 2, {"first", "the second"});
  const auto other = read(folder.path(), 2, "case 2");
  CHECK_FALSE(other.memory);
  CHECK_THAT(other.refused.at(0), Catch::Contains("case 1, not case 2"));
  std::ofstream(folder / "checkpoint.2.0") << "half of what a process writes when it is killed";
  CHECK(read(folder.path(), 3).memory == "the second");
  fs::remove(folder / "checkpoint");
  CHECK(read(folder.path(), 3).memory == "first");
}
