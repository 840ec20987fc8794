#include "post/files/checkpoints.hpp"

#include <fstream>
#include <mutex>

#include "post/files/atomic_file.hpp"
#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/small_run.hpp"

using namespace post;
namespace fs = std::filesystem;

namespace {

/// By so many processes, each with one point of its own.
void write(const fs::path& folder, int processes, const std::vector<std::string>& memories) {
  thread_ranks::run(processes, [&](const plate::Communicator& all) {
    DistributedCheckpoints checkpoints(all, folder, "case 1");
    for (const auto& memory : memories) checkpoints.write(memory, {1, {{all.rank(), 0}}, {double(memory.size())}});
  });
}

struct ReadBack {
  std::optional<std::string> memory;
  std::size_t parts = 0;
  std::vector<std::string> refused;
};

/// By so many; all must have found the same.
ReadBack read(const fs::path& folder, int processes, const std::string& of = "case 1") {
  std::vector<ReadBack> found;
  std::mutex one_by_one;
  thread_ranks::run(processes, [&](const plate::Communicator& all) {
    ReadBack own;
    if (auto one = DistributedCheckpoints(all, folder, of).read(own.refused))
      own.memory = one->memory, own.parts = one->parts.size();
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

TEST_CASE("shared checkpoints: the newest comes back to any number of processes") {
  const small_run::TemporaryFolder folder;
  CHECK_FALSE(read(folder.path(), 3).memory);
  write(folder.path(), 3, {"first", std::string("second\n\0 of all", 15)});
  for (const int processes : {1, 2, 5}) {
    const auto found = read(folder.path(), processes);
    CHECK(found.memory == std::string("second\n\0 of all", 15));
    CHECK(found.parts == 3);
    CHECK(found.refused.empty());
  }
  thread_ranks::run(
      2, [&](const plate::Communicator& all) { DistributedCheckpoints(all, folder.path(), "case 1").remove(); });
  CHECK(folder.entries() == 0);
}

TEST_CASE("shared checkpoints: one that is damaged anywhere gives the one before, with a word about it") {
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

TEST_CASE("shared checkpoints: one of another run is refused, the last two stay whole while a third is written") {
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
